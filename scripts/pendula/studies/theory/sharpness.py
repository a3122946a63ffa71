"""How near the bounds of Theorems 1 to 3 data come, and what grows with the length of the chain."""

import numpy as np
from latticode.datasets.checks import table, variable
from latticode.measures.norms import power_of
from latticode.numerics.elementary import log

from pendula.models.bounds import (
    extent,
    theorem_1_bound,
    theorem_2_bound,
    theorem_2_gap,
    theorem_3_bound,
)
from pendula.problem import Constants

from .equations import ENDS, PAIR, alternating, constants_at, one_pair, total_energy
from .stability import edge_wave

SIZE = 1e-5
"""Amplitude of tiny data: the cubic terms change ratios by its square."""


def check_sharpness(sites: int) -> dict:
    """Find what part of each bound the worst data known reach at Omega = 8 or -4.

    For Theorems 1 and 2 these are tiny: A = -B in the wave at the edge of the band. By the linear
    equations P goes from its least value to its largest, where the phase is another by a quarter
    of a turn, and H stays. For Theorem 3 they are A = -B = (-1)^n x at rest with x^2 = 2 c, the
    state at which its bound is attained where no end breaks the wave and Omega is not positive.

    The paper gives no C_0 of Theorem 2. In the limit of small delta, the inequality of its proof,
    C delta / (|Omega| - 2 gamma - C_0 delta / 4) <= C_0 delta with |H| <= C delta, gives
    `limit_constant`, and the wave needs `least_constant`.
    """
    above, below = constants_at(8.0), constants_at(-4.0)
    high, low = (SIZE * edge_wave(one.omega, sites) for one in (above, below))
    power, gap = power_of(low), theorem_2_gap(below)
    least, largest = (total_energy(below, ENDS, z) for z in (low, 1j * low))
    limit = extent(below) / gap
    rough = alternating(sites, np.sqrt(2.0 * extent(below)))
    of_rough = theorem_3_bound(total_energy(below, ENDS, rough), sites, below)
    reached = {
        "theorem_1": power / theorem_1_bound(total_energy(above, ENDS, 1j * high), above),
        "theorem_2": power / theorem_2_bound(largest, power, below),
        "theorem_2_ball": least / largest / limit,
        "theorem_3": power_of(rough) / of_rough,
    }
    return table(
        "What part of the bounds of Theorems 1 to 3 is reached",
        {"form": list(reached)},
        sites=variable(sites, (), "number of sites N"),
        reached=variable(list(reached.values()), ("form",), "largest P over its bound"),
        limit_constant=variable(limit, (), "C_0 of the proof of Theorem 2 for tiny data"),
        least_constant=variable(least / largest, (), "least C_0 that the wave allows"),
    )


def largest_of_energy(constants: Constants, sites: int, energy: float) -> float:
    """Return the largest P that A = -B = (-1)^n x has at this energy.

    H is N x^4 / 2 and a multiple of x^2.
    """
    quartic = 0.5 * sites
    square = total_energy(constants, ENDS, alternating(sites, 1.0)) - quartic
    root = np.sqrt(square * square + 4.0 * quartic * energy)
    return 2.0 * sites * (root - square) / (2.0 * quartic)


def check_chain_growth(sizes) -> dict:
    """Compare chains of two `sizes`: C_N of Theorem 3, and the largest P of data of one energy.

    The energy is that of one pair. Where the largest P of that energy grows with N, so must each
    bound in terms of H.
    """
    exponents, omegas, dims = [], [0.0, 8.0], ("omega",)
    for constants in map(constants_at, omegas):
        energies = [total_energy(constants, ENDS, one_pair(n, PAIR)) for n in sizes]
        grown = [
            [theorem_3_bound(h, n, constants), largest_of_energy(constants, n, h)]
            for n, h in zip(sizes, energies, strict=True)
        ]
        exponents.append(np.diff(log(grown), axis=0)[0] / log(sizes[1] / sizes[0]))
    of_bound, of_shell = np.transpose(exponents)
    return table(
        "What grows with the length of the chain: C_N, and the largest P of one energy",
        {"omega": omegas},
        constant_exponent=variable(of_bound, dims, "exponent in N of C_N"),
        shell_exponent=variable(of_shell, dims, "exponent in N of the largest P of one energy"),
    )
