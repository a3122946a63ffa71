"""Checks of the sharpness of Theorems 1 to 3, and of errors in their proofs.

P is |A|^2 + |B|^2 in l2, and delta its initial value. The constants a, c, C_0 and C_N are those of
`pendula.models.bounds`.
"""

import numpy as np
from latticode.datasets.checks import table, variable
from latticode.measures.norms import power_of
from latticode.numerics.elementary import log, square_modulus
from replication.variables import FEW_CHOICES

from pendula.models.bounds import (
    extent,
    theorem_1_bound,
    theorem_2_bound,
    theorem_2_constants,
    theorem_2_gap,
    theorem_3_bound,
)
from pendula.problem import Constants

from .equations import ENDS, PAIR, alternating, constants_at, one_pair, total_energy
from .stability import edge_wave

TINY = 1e-5
"""Amplitude of tiny data. Cubic terms change ratios in proportion to its square."""
SQUARES = (20.0, 25.0, 40.0, 60.0)
"""Values of x^2 for A = -B = (-1)^n x at Omega = -4: 20, where H is least, and larger ones."""
LONG, SIZES = 513, (11, 81)
"""Number of sites of a chain on which data nearly attain the bounds, and of two compared chains."""


def check_sharpness() -> dict:
    """Return the largest known share of each bound that data attain at Omega = 8 or -4.

    For Theorems 1 and 2 the data are tiny: A = -B in the wave at the edge of the band. By the
    linear equations H is constant, and P goes from its least to its largest value while the phase
    advances by a quarter of a turn. For Theorem 3 the data are A = -B = (-1)^n x with the best of
    SQUARES. Without ends these data would attain its bound for any x^2 >= 2 c if Omega <= 0. With
    ends they attain a share that grows with x.

    The paper prints no constants for bounds in terms of delta. P of the wave reaches
    `least_constant` delta. For small delta the inequalities of the proofs give P <=
    `proof_constant` delta. This constant is the largest |H| / delta divided by the least |H| / P.
    The proof of Theorem 1 has H <= (Omega + 2 gamma) delta. The proof of Theorem 2 has |H| <= c
    delta and c delta / (|Omega| - 2 gamma - C_0 delta / 4) <= C_0 delta.
    """
    above, below = constants_at(8.0), constants_at(-4.0)
    high, low = (TINY * edge_wave(constants.omega, LONG) for constants in (above, below))
    power = power_of(low)
    (least, largest), (top, bottom) = (
        [total_energy(constants, ENDS, z) for z in (wave, 1j * wave)]
        for constants, wave in ((below, low), (above, high))
    )
    rough = [alternating(LONG, np.sqrt(square)) for square in SQUARES]
    reached = {
        "theorem_1": power / theorem_1_bound(bottom, above),
        "theorem_2": power / theorem_2_bound(largest, power, below),
        "theorem_3": max(
            power_of(z) / theorem_3_bound(total_energy(below, ENDS, z), LONG, below) for z in rough
        ),
    }
    upper = above.omega + 2.0 * above.gamma
    constants = {
        "theorem_1": (theorem_1_bound(upper, above), top / bottom),
        "theorem_2": (extent(below) / theorem_2_gap(below), least / largest),
    }
    of_proof, of_wave = zip(*constants.values(), strict=True)
    return table(
        "Attained share of the bounds of Theorems 1 to 3",
        {"form": list(reached), "theorem": list(constants)},
        sites=variable(LONG, (), "number of sites N"),
        reached=variable(list(reached.values()), ("form",), "largest P divided by its bound"),
        proof_constant=variable(of_proof, ("theorem",), "the proof's bound over small delta"),
        least_constant=variable(of_wave, ("theorem",), "largest over least P of the wave"),
    )


def largest_of_energy(constants: Constants, sites: int, energy: float) -> float:
    """Return the largest P of A = -B = (-1)^n x at this energy.

    H is N x^4 / 2 plus a multiple of x^2.
    """
    quartic = 0.5 * sites
    square = total_energy(constants, ENDS, alternating(sites, 1.0)) - quartic
    root = np.sqrt(square * square + 4.0 * quartic * energy)
    return 2.0 * sites * (root - square) / (2.0 * quartic)


def check_chain_growth() -> dict:
    """Return the exponents of N in C_N of Theorem 3 and in the largest P at one energy.

    The energy is that of one excited pair, on chains of two SIZES. If the largest P at this energy
    grows with N, every bound in terms of H must grow too.
    """
    exponents, omegas, dims = [], [0.0, 8.0], ("omega",)
    for constants in map(constants_at, omegas):
        energies = [total_energy(constants, ENDS, one_pair(n, PAIR)) for n in SIZES]
        grown = [
            [theorem_3_bound(h, n, constants), largest_of_energy(constants, n, h)]
            for n, h in zip(SIZES, energies, strict=True)
        ]
        exponents.append(np.diff(log(grown), axis=0)[0] / log(SIZES[1] / SIZES[0]))
    of_bound, of_shell = np.transpose(exponents)
    data = table(
        "Growth with the length of the chain: of C_N, and of the largest P at one energy",
        {"omega": omegas},
        constant_exponent=variable(of_bound, dims, "exponent of N in C_N"),
        shell_exponent=variable(of_shell, dims, "exponent of N in the largest P at one energy"),
    )
    data["coords"]["omega"]["attrs"] |= FEW_CHOICES
    return data


# --- Errors in the proofs, with small examples ----------------------------------------------------


def check_errata() -> dict:
    """Return examples of the errors in the proofs of Theorems 2 and 3, at Omega = -4.

    The bound printed in Theorem 3's proof has gamma in place of 2 gamma.
    """
    constants, sizes, dims = constants_at(-4.0), np.arange(1, 10, 2), ("sites",)
    printed, corrected = (
        np.array([margin(constants, n, drive) for n in sizes]) for drive in (1.0, 2.0)
    )
    smallest = sizes[printed < 0.0].min()
    return table(
        "Errors in the proofs of Theorems 2 and 3",
        {"sites": sizes},
        printed=variable(printed, dims, "H minus the bound with gamma, as printed"),
        corrected=variable(corrected, dims, "H minus the bound with 2 gamma"),
        smallest=variable(smallest, (), "sites of the smallest chain that violates the bound"),
        **without_continuity(constants),
    )


def margin(constants: Constants, sites: int, drive: float) -> float:
    """Return H minus its lower bound in Theorem 3's proof for A_n = -B_n = (-1)^n.

    The bound contains `drive` times gamma. The quartic terms cancel, so the sign is the same for
    data of any size.
    """
    z = alternating(sites, 1.0)
    quartic = 0.25 * np.sum(square_modulus(z) ** 2)
    constant = abs(constants.omega) + drive * constants.gamma + 4.0 * constants.epsilon
    return float(total_energy(constants, ENDS, z) - quartic + constant * power_of(z))


def without_continuity(constants: Constants) -> dict:
    """Return data that satisfy all premises of the printed proof of Theorem 2, but violate (24).

    For small data, here delta = delta_0 / 2, the premises are (25), a constant -H > 0, and |H| <= c
    delta. The proof concludes P <= C_0 delta. The premises do not exclude states beyond the barrier
    of (25), P = 2 a: one excited pair (x, 0) there has the same energy. The continuity of P
    excludes these states, because P starts below 2 a.
    """
    delta_0, c_0 = theorem_2_constants(constants)
    delta, gap = 0.5 * delta_0, theorem_2_gap(constants)
    sizes = np.linspace(0.0, 6.0, 20001)[1:]
    pairs = np.stack([sizes, 0.0 * sizes], axis=1)[:, :, None].astype(complex)
    powers, depth = sizes**2, -total_energy(constants, ENDS, pairs)
    premises = (depth > 0.0) & (depth <= extent(constants) * delta)
    premises &= depth >= gap * powers - 0.25 * powers**2
    below = powers[premises & (powers < 2.0 * gap)].max()
    return {
        "delta_0": variable(delta_0, (), "largest delta by the inequalities of Theorem 2's proof"),
        "allowed_power": variable(c_0 * delta, (), "C_0 delta of the small data"),
        "largest_power": variable(powers[premises].max(), (), "largest P that the premises allow"),
        "largest_power_below": variable(below, (), "the same below the barrier"),
        "barrier_power": variable(2.0 * gap, (), "P at the barrier of (25), 2 a"),
    }
