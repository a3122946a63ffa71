"""How near data come to the bounds of Theorems 1 to 3: data drawn at random, and the worst found.

Random data lie inside the proven regions, where no bound may be broken. A search finds the worst
ones, which tell how sharp the bounds are. A bound depends on H alone, or is a multiple of P(0). In
the first case the largest P of a run is that of a state which has the same H and could be the start
of the run: so the worst data are searched for among states, and a run only confirms them. In the
second case every candidate is run.

The search for Theorem 3 needs a limit on P, for P / C_N grows with the size of data of any shape:
with H = q P + r P^2, abs(q) <= c, r >= 1 / (8 N), C_N / P is 4 N times c x + sqrt(c^2 x^2 +
(q x + r) / (2 N)), x = 1 / P, which is convex in x and does not fall at x = 0. As P goes to
infinity the ratio goes to one where all amplitudes are equally large. Here P is at most 8 N c: all
larger states have H > 0.
"""

import numpy as np

from pendula.datasets.checks import columns, table, variable
from pendula.measures.norms import power_of
from pendula.models import bounds
from pendula.models.linear_chain import curvatures
from pendula.numerics.draws import exponential, normal, uniform
from pendula.numerics.elementary import complex_of, exp, square_modulus
from pendula.numerics.search import maximise_all
from pendula.problem import Constants

from .equations import (
    BOUNDARIES,
    alternating,
    draw_shape,
    misstated,
    run_powers,
    total_energy,
)

BOUNDS = {
    "theorem_1": lambda energy, start, sites, k: bounds.theorem_1_bound(energy, k),
    "theorem_2_ball": lambda energy, start, sites, k: bounds.theorem_2_constants(k)[1] * start,
    "theorem_2_energy": lambda energy, start, sites, k: bounds.theorem_2_bound(energy, start, k),
    "theorem_2_widened": lambda energy, start, sites, k: bounds.widened_bound(energy, start, k),
    "theorem_3": lambda energy, start, sites, k: bounds.theorem_3_bound(energy, sites, k),
}
"""What each family's theorem gives for a bound on P of data with this H and P(0), as arrays."""
FAMILIES = tuple(BOUNDS)
LARGEST = {
    "theorem_1": lambda k: 60.0,
    "theorem_2_ball": lambda k: 0.999 * bounds.theorem_2_constants(k)[0],
    "theorem_2_energy": lambda k: 2.0 * bounds.theorem_2_gap(k),
    "theorem_2_widened": lambda k: bounds.widened_barrier(k)[0],
    "theorem_3": lambda k: 60.0,
}
"""The largest P(0) to draw for each family."""


def draw_case(rng: np.random.Generator, family: str, sites: int, gamma_times: float):
    """Return (constants, boundary, amplitudes, bound on P) inside a family's region.

    The bound is that of a statement whose gamma is `gamma_times` the right one.
    """
    while True:
        epsilon, gamma = uniform(rng, 0.2, 2.0), uniform(rng, 0.0, 2.0)
        if family == "theorem_1":
            omega = 2.0 * gamma + 4.0 * epsilon + exponential(rng)
        elif family == "theorem_3":
            omega = uniform(rng, -6.0, 10.0)
        else:
            omega = -2.0 * gamma - uniform(rng, 0.1, 4.0)
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        boundary = "dirichlet" if family == "theorem_2_widened" else str(rng.choice(BOUNDARIES))
        part = uniform(rng, 1e-3, 1.0)
        power = LARGEST[family](constants) * part * part
        amplitudes = np.sqrt(power) * draw_shape(rng, sites)
        energy = total_energy(constants, boundary, amplitudes)
        stated = misstated(constants, gamma_times=gamma_times)
        limit = float(BOUNDS[family](energy, power, sites, stated))
        if np.isfinite(limit):
            return constants, boundary, amplitudes, limit


def check_samples(count: int, end_time: float, sizes, seed: int, gamma_times: float = 1.0) -> dict:
    """Run `count` random cases of each size inside each region; compare the largest P and bound.

    The parameters are drawn too, and ends of all kinds.
    """
    ratio, outputs = np.zeros((len(FAMILIES), len(sizes), count)), round(10 * end_time)
    for i, family in enumerate(FAMILIES):
        for j, sites in enumerate(sizes):
            rng = np.random.default_rng([seed, i, j])
            drawn = [draw_case(rng, family, sites, gamma_times) for _ in range(count)]
            constants, boundaries, amplitudes, limits = zip(*drawn, strict=True)
            powers, _ = run_powers(constants, boundaries, amplitudes, end_time, outputs)
            ratio[i, j] = powers.max(axis=1) / limits
    coords = {"family": FAMILIES, "sites": sizes, "sample": np.arange(count)}
    return table(
        "Largest P over its bound for random data inside the proven regions",
        coords,
        sampled=variable(ratio, coords, "largest P over its bound", tolerance=LIMIT),
        worst_sample=variable(ratio.max(axis=(1, 2)), ("family",), "the worst of each family"),
    )


OMEGAS = {"theorem_1": 8.0, "theorem_2": -4.0, "theorem_3": -4.0}
QUESTIONS = [
    (family, boundary)
    for boundary in ("dirichlet", "periodic")
    for family in FAMILIES
    if (family, boundary) != ("theorem_2_widened", "periodic")  # it needs ends at rest
]

RUN = ("theorem_2_ball",)
"""Families whose bound is a multiple of P(0)."""
LIMIT = 1.0 + 1e-7
"""The largest P over its bound that solvers and rounding can lead to."""
SAME_HILL = 1e-6
"""Searches whose values differ by less end at the same data, or at their images by a symmetry."""


def decode(points: np.ndarray, family: str, constants: Constants) -> np.ndarray:
    """Return the amplitudes (count, 2, N) that points of the search (count, 4N + 1) stand for.

    The last number sets P, squeezed into the range of the search.
    """
    raw = points[:, :-1].reshape(len(points), 4, -1)
    shapes, limit = complex_of(raw[:, 0::2], raw[:, 1::2]), LARGEST[family](constants)
    if family == "theorem_3":
        limit = 8.0 * raw.shape[2] * bounds.extent(constants)
    powers = limit / (1.0 + exp(-np.minimum(np.maximum(points[:, -1], -20.0), 20.0)))
    return np.sqrt(powers / np.sum(raw * raw, axis=(1, 2)))[:, None, None] * shapes


def ratios(family: str, constants, stated, boundary, end_time, points) -> np.ndarray:
    """Return P over its bound for each point, its largest P where a run is needed to know.

    `end_time` is that of runs. Outside the region values are negative.
    """
    amplitudes = decode(points, family, constants)
    if family in RUN:
        powers, energies = follow(constants, boundary, amplitudes, end_time)
    else:
        powers = np.sum(square_modulus(amplitudes), axis=(1, 2))[:, None]
        energies = total_energy(constants, boundary, amplitudes)
    limits = BOUNDS[family](energies, powers[:, 0], amplitudes.shape[2], stated)
    inside = np.isfinite(limits)
    # outside, the energy leads back to where it lies below the barrier
    return np.where(inside, powers.max(axis=1) / np.where(inside, limits, 1.0), -np.abs(energies))


def follow(constants: Constants, boundary: str, amplitudes, end_time: float):
    """Return P (run, time) of runs from each of `amplitudes` and their energies (run,)."""
    count, outputs = len(amplitudes), round(10 * end_time)
    return run_powers([constants] * count, [boundary] * count, amplitudes, end_time, outputs)


def supremum(family: str, constants: Constants, sites: int, boundary: str) -> float:
    """Return the ratio that tiny data reach in the mode nearest to the theorem's estimate.

    For Theorem 1 the mode of largest curvature, for Theorem 2 that of the smallest; the ball of
    Theorem 2 asks for growth, whose linear value is (kappa + 2 gamma) / (kappa - 2 gamma). The
    constant of Theorem 3 is reached by |A_n| = |B_n|, A = -B, alternating, on an even ring.
    """
    epsilon, gamma, omega = constants
    kappa = epsilon * curvatures(sites, boundary) - omega
    least = np.abs(kappa).min()
    if family == "theorem_1":
        return (omega - 2 * gamma - 4 * epsilon) / (least - 2 * gamma)
    if family == "theorem_2_ball":
        return (least + 2 * gamma) / (least - 2 * gamma) / bounds.theorem_2_constants(constants)[1]
    if family == "theorem_3":
        return 1.0
    return bounds.theorem_2_gap(constants) / (least - 2 * gamma)


def check_worst(
    gamma, epsilon, sites, end_time, generations, population, starts, seed, gamma_times=1.0
) -> dict:
    """Search data on N sites, ends at rest or joined, for the largest P over each bound.

    Each question has as many searches as `starts`, as a search may end on a lower hill; where every
    candidate is run one is enough, since those find one hill.
    """
    questions = []
    for family, boundary in QUESTIONS:
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=OMEGAS[family[:9]])
        stated = misstated(constants, gamma_times=gamma_times)
        questions.append((family, constants, stated, boundary))
    counts = [1 if family in RUN else starts for family, _ in QUESTIONS]
    keys = [[seed, number, i] for number, count in enumerate(counts) for i in range(count)]
    halves = [normal(np.random.default_rng(key), 2 * sites) for key in keys]
    firsts = np.array([[*half, *-half, 0.0] for half in halves])  # A = -B: the drive acts on it
    ends = np.cumsum(counts)[:-1]

    def objective(points: np.ndarray) -> np.ndarray:
        """Return the values of all searches, those of one question by one call."""
        parts = zip(questions, np.split(points, ends), strict=True)
        values = [ratios(*own, end_time, np.concatenate(part)) for own, part in parts]
        return np.concatenate(values).reshape(len(points), -1)

    searched = maximise_all(objective, firsts, 0.5, generations, population, keys)
    rows, history = [], []
    parts = (np.split(part, ends) for part in searched)
    for question, points, values, rises in zip(questions, *parts, strict=True):
        family, constants, stated, boundary = question
        data = decode(points[[np.argmax(values)]], family, constants)
        powers, energies = follow(constants, boundary, data, end_time)
        limit = float(BOUNDS[family](energies[0], powers[0, 0], sites, stated))
        history.append(rises.max(axis=0))
        row = {
            "searched_family": family,
            "boundary": boundary,
            "worst": values.max(),
            "followed": powers.max() / limit,
            "agreeing": np.mean(values > values.max() - SAME_HILL),
            "last_rise": history[-1][-1] - history[-1][3 * generations // 4],
            "small_data": supremum(family, constants, sites, boundary),
        }
        rows.append(row)
    about = {
        "searched_family": "family of the bound",
        "boundary": "ends of the chain",
        "worst": ("largest P over its bound found", LIMIT),
        "followed": ("the same along a run from those data", LIMIT),
        "agreeing": "share of the searches that end there",
        "last_rise": ("rise over the last quarter of the generations", SAME_HILL),
        "small_data": "its value for tiny data in the nearest mode",
    }
    numbers = {name: [row[name] for row in rows] for name in about}
    coords = {
        "question": [f"{family}, {boundary}" for family, boundary in QUESTIONS],
        "generation": np.arange(1, generations + 1),
    }
    attained = attained_theorem_3(epsilon, gamma, gamma_times)
    return table(
        f"The worst data found on {sites} sites for the bounds of Theorems 1 to 3",
        coords,
        sites=variable(sites, (), "number of sites N"),
        **columns(("question",), about, numbers),
        progress=variable(np.array(history), coords, "best after each generation"),
        attained=variable(attained, (), "P over C_N on a ring of two", tolerance=LIMIT),
    )


def attained_theorem_3(epsilon: float, gamma: float, gamma_times: float) -> float:
    """Return P / C_N for the state at which Theorem 3's bound is attained: it must be one.

    On a ring of two sites A = -B = (x, -x) with x^2 = 2 c, which is the larger root of
    P^2 / (8 N) - c P = H.
    """
    constants = Constants(epsilon=epsilon, gamma=gamma, omega=OMEGAS["theorem_3"])
    amplitudes = alternating(2, np.sqrt(2.0 * bounds.extent(constants)))
    energy = ring_energy(constants, amplitudes)
    stated = misstated(constants, gamma_times=gamma_times)
    return float(power_of(amplitudes) / bounds.theorem_3_bound(energy, 2, stated))


def ring_energy(constants: Constants, amplitudes: np.ndarray) -> float:
    """Return H of (8) on a ring with any number of sites, written apart from the library's."""
    epsilon, gamma, omega = constants
    density = square_modulus(amplitudes)
    difference = amplitudes[0] - amplitudes[1]
    bonds = np.sum(square_modulus(np.roll(amplitudes, -1, axis=1) - amplitudes))
    drive = gamma * np.sum(difference.real**2 - difference.imag**2)
    return float(np.sum(0.25 * density**2 + omega * density) - drive - epsilon * bonds)
