"""How near the bounds of Theorems 1 to 3 tiny or extremal data come on longer and longer chains.

And what grows with the chain: the constant C_N of Theorem 3, the norm that is reached from one
pair, and the largest norm that data of one energy have.
"""

import numpy as np
from latticode.datasets.checks import table, variable
from latticode.measures.confidence import mean_limits
from latticode.measures.growth import lay_line
from latticode.measures.norms import power_of
from latticode.numerics.draws import uniform
from latticode.numerics.elementary import complex_of, log

from pendula.models.bounds import extent, theorem_2_gap, theorem_3_bound
from pendula.models.linear_chain import curvatures, flow, modes
from pendula.problem import Constants

from .equations import (
    alternating,
    one_pair,
    run_powers,
    total_energy,
)
from .samples import BOUNDS, OMEGAS

FORMS = ("theorem_1", "theorem_2", "theorem_2_ball", "theorem_3")
SIZE = 1e-5
"""Amplitude of tiny data: the cubic terms change ratios by its square."""
LOOSE = {"rtol": 1e-9, "atol": 1e-12}
"""Tolerances of runs of which only a mean is taken."""


def reached(form: str, constants: Constants, sites: int) -> float:
    """Return P over its bound of this form for the best data known on a Dirichlet chain.

    For Theorem 3 that is A = -B = (-1)^n x at rest with x^2 = 2 c, the state at which its bound is
    attained where no end breaks the wave and Omega is not positive. For the others it is tiny: A =
    -B in the wave nearest to the band's edge, which starts in the phase in which P is least and is
    carried, by the exact linear flow, for a quarter of its period, to where P is largest.
    """
    if form == "theorem_3":
        data = alternating(sites, np.sqrt(2.0 * extent(constants)))
        largest = power_of(data)
    else:
        low, (epsilon, gamma, omega) = constants.omega < 0.0, constants
        k = 0 if low else sites - 1
        kappa = epsilon * curvatures(sites, "dirichlet")[k] - omega
        quarter = 0.5 * np.pi / np.sqrt((kappa - 2.0 * gamma) * (kappa + 2.0 * gamma))
        start = SIZE * modes(sites, "dirichlet")[k] * (1.0 if low else 1j)
        data = np.stack([start, -start]).astype(complex)
        largest = power_of(flow(data, quarter, epsilon, gamma, omega, "dirichlet"))
    energy, power = total_energy(constants, "dirichlet", data), power_of(data)
    if form == "theorem_2_ball":
        return float(largest / (limit_constant(constants) * power))
    family = "theorem_2_energy" if form == "theorem_2" else form
    return float(largest / BOUNDS[family](energy, power, sites, constants))


def limit_constant(constants: Constants) -> float:
    """Return C_0 of Theorem 2 as the inequality before its end gives it where delta goes to zero.

    The paper gives no number: C delta / (|Omega| - 2 gamma - C_0 delta / 4) <= C_0 delta, where
    |H| <= C delta. A larger delta_0 takes a larger C_0, twice this one in `models.bounds`. Outside
    the range of parameters of the theorem it is infinite.
    """
    gap = theorem_2_gap(constants)
    return extent(constants) / gap if gap > 0.0 else np.inf


def least_constant(constants: Constants) -> float:
    """Return the least C_0 that tiny data on an infinite chain allow."""
    omega, drive = abs(constants.omega), 2.0 * constants.gamma
    return (omega + drive) / (omega - drive)


def check_sharpness(epsilon: float, gamma: float, sizes) -> dict:
    """Find what part of each bound is reached on ever longer chains."""
    ratios = []
    for form in FORMS:
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=OMEGAS[form[:9]])
        ratios.append([reached(form, constants, int(n)) for n in sizes])
    negative = Constants(epsilon=epsilon, gamma=gamma, omega=OMEGAS["theorem_2"])
    limit, least = limit_constant(negative), least_constant(negative)
    return table(
        "What part of the bounds of Theorems 1 to 3 is reached on longer and longer chains",
        {"form": FORMS, "sites": sizes},
        reached=variable(ratios, ("form", "sites"), "largest P over its bound of the best data"),
        limit_constant=variable(limit, (), "C_0 of the proof of Theorem 2 for tiny data"),
        least_constant=variable(least, (), "least C_0 that tiny data on an infinite chain allow"),
    )


def check_chain_growth(
    epsilon: float, gamma: float, omegas, sizes, pair, end_time: float, members: int, seed: int
) -> dict:
    """Set C_N of Theorem 3 beside the P that one pair reaches on ever longer chains, at each Omega.

    Each member starts a little, 1e-6, off the pair: where the motion is chaotic that makes another
    run. The exponent of P in N is fitted for each member; the mean has limits by Student's t.
    """
    sizes, outputs = np.asarray(sizes), 4 * round(end_time)
    late, bounds = np.empty((len(omegas), members, len(sizes))), np.empty((len(omegas), len(sizes)))
    for k, omega in enumerate(omegas):
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        rng = np.random.default_rng(seed)
        for i, n in enumerate(map(int, sizes)):
            data = one_pair(n, pair)
            bounds[k, i] = theorem_3_bound(total_energy(constants, "dirichlet", data), n, constants)
            off = uniform(rng, -1.0, 1.0, (members, 2, 2, n))
            starts = data + 1e-6 * complex_of(off[:, 0], off[:, 1])
            runs = [constants] * members, ["dirichlet"] * members, starts, end_time, outputs, LOOSE
            late[k, :, i] = run_powers(*runs)[0][:, outputs // 2 :].mean(axis=1)
    x, dims = log(sizes), ("omega",)
    limits = [mean_limits([lay_line(x, log(powers)).slope for powers in one]) for one in late]
    mean, least, most = np.array(limits).T
    slopes = [lay_line(x, log(one)).slope for one in bounds]
    says = "mean of P over the second half of a run"
    return table(
        "What grows with the length of the chain: C_N, and the norm reached from one pair",
        {"omega": omegas, "member": np.arange(members), "sites": sizes},
        late_power=variable(late, ("omega", "member", "sites"), says),
        constant_n=variable(bounds, ("omega", "sites"), "C_N of Theorem 3"),
        constant_exponent=variable(slopes, dims, "exponent of C_N in N"),
        power_exponent=variable(mean, dims, "exponent of that P in N"),
        power_exponent_low=variable(least, dims, "lower confidence limit of that exponent"),
        power_exponent_high=variable(most, dims, "upper confidence limit of that exponent"),
    )


def shell_state(constants: Constants, sites: int, energy: float) -> np.ndarray | None:
    """Return A = -B = (-1)^n x, with x at its largest, of this energy; None if none has it.

    The energy falls from zero where it can and grows with x^4 in the end.
    """
    unit = alternating(sites, 1.0)
    sizes = np.sqrt(2.0 * extent(constants)) * np.linspace(0.0, 1.0, 101)
    energies = total_energy(constants, "dirichlet", sizes[:, None, None] * unit)
    if min(energies) > energy:
        return None
    low, high = sizes[int(np.argmin(energies))], 1e3
    for _ in range(60):
        middle = 0.5 * (low + high)
        below = total_energy(constants, "dirichlet", middle * unit) < energy
        low, high = (middle, high) if below else (low, middle)
    return low * unit


def check_energy_shell(epsilon: float, gamma: float, omegas, sizes, pair) -> dict:
    """Find data of the energy of one pair and with the largest norm: does H bound P, for any N?

    And whether H is definite near zero: its least and largest value over P for tiny data. At each
    Omega.
    """
    sizes, longest = np.asarray(sizes), int(sizes[-1])
    flat = SIZE * np.ones(longest)
    tiny = np.stack([alternating(longest, SIZE), np.stack([1j * flat, -1j * flat])])
    exponents, quotients = [], []
    for omega in omegas:
        constants, powers = Constants(epsilon=epsilon, gamma=gamma, omega=omega), []
        for n in map(int, sizes):
            data = one_pair(n, pair)
            found = shell_state(constants, n, total_energy(constants, "dirichlet", data))
            powers.append(power_of(data if found is None else found))
        exponents.append(lay_line(log(sizes), log(powers)).slope)
        over = total_energy(constants, "dirichlet", tiny) / [power_of(one) for one in tiny]
        quotients.append([over.min(), over.max()])
    least, most = np.transpose(quotients)
    return table(
        "The largest norm of data that have the energy of one pair",
        {"omega": omegas},
        shell_exponent=variable(exponents, ("omega",), "exponent in N of the largest P of them"),
        least_quotient=variable(least, ("omega",), "least H / P of tiny data"),
        largest_quotient=variable(most, ("omega",), "largest H / P of tiny data"),
    )
