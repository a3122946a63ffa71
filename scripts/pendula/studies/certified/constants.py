"""Balls around the constants of the paper's theorems that the study `theory` computes in doubles.

Data and parameters are the decimal fractions that the configuration prints, so that one tenth is
one tenth and not the double next to it. The formulas are those of `models.bounds` and of
`models.linear_chain`, which say where each comes from, written again: with a = |Omega| - 2 gamma
and c = |Omega| + 2 gamma + 4 epsilon,

    Theorem 1: C = H / (Omega - 2 gamma - 4 epsilon) where that is positive;
    Theorem 2, Omega < -2 gamma: delta_0 = a^2 / c, C_0 = 2 c / a, the barrier a^2;
    Theorem 3: C_N = 4 N (c + sqrt(c^2 + H / (2 N)));
    Lemma 1 on N sites at rest beyond their ends: the least |4 epsilon sin^2(k pi / (2 N + 2)) -
    Omega| / 2 over k = 1..N; on the infinite chain the distance of Omega from [0, 4 epsilon] by 2.

Theorem 2 with the bonds kept needs a root: -H >= g(P), where g is concave, vanishes at zero and is
largest at a known P, its top. If g(low) < -H < g(high) for low < high <= top, the smaller root of
g(P) = -H lies between them. Proof: the root is at most `high` by continuity; g >= -H holds on an
interval that reaches to the top, since g is concave, and `low` is not in it.
"""

from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from flint import acb, arb

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents
from pendula.ends import DIRICHLET, FREE, PERIODIC, kind_of
from pendula.problem import Constants, Problem

from . import balls

HALVINGS = 100
"""Of the interval of a root: more than a double resolves."""


class Parameters(NamedTuple):
    """The constants of the equations as balls, around the printed decimals."""

    epsilon: arb
    gamma: arb
    omega: arb

    @classmethod
    def of(cls, constants: Constants) -> "Parameters":
        return cls(*(balls.decimal(getattr(constants, name)) for name in cls._fields))

    @property
    def of_theorems(self) -> "Parameters":
        """Return those of the staggered chain if epsilon < 0 (see `models.bounds`), gamma >= 0."""
        if self.epsilon < 0:
            return Parameters(-self.epsilon, abs(self.gamma), self.omega - 4 * self.epsilon)
        return self._replace(gamma=abs(self.gamma))

    @property
    def extent(self) -> arb:
        """Return c."""
        return abs(self.omega) + 2 * self.gamma + 4 * self.epsilon

    @property
    def gap(self) -> arb:
        """Return a = -Omega - 2 gamma, positive where Theorem 2 applies."""
        return -self.omega - 2 * self.gamma


def energy(k: Parameters, boundary: str, amplitudes: np.ndarray) -> arb:
    """Return H of equation (8) of complex amplitudes (2, N)."""
    a, b = ([acb(balls.decimal(z.real), balls.decimal(z.imag)) for z in row] for row in amplitudes)
    total = arb(0)
    for own in (a, b):
        squares = [_square(z) for z in own]
        total += sum((x * x / 4 + k.omega * x for x in squares), arb(0))
        # with the bonds to the resting neighbours of the ends
        chain = {DIRICHLET: [acb(0), *own, acb(0)], FREE: own, PERIODIC: [*own, own[0]]}
        bonds = pairwise(chain[kind_of(boundary)])
        total -= k.epsilon * sum((_square(after - before) for before, after in bonds), arb(0))
    # A B + c.c. - (A^2 + B^2 + c.c.) / 2 = -Re (A - B)^2
    return total - k.gamma * sum((((z - w) * (z - w)).real for z, w in zip(a, b, strict=True)), 0)


def _square(z: acb) -> arb:
    return z.real * z.real + z.imag * z.imag


def power(amplitudes: np.ndarray) -> arb:
    """Return P of complex amplitudes."""
    parts = [*amplitudes.real.ravel(), *amplitudes.imag.ravel()]
    return sum((balls.decimal(x) * balls.decimal(x) for x in parts), arb(0))


def theorem_3(k: Parameters, h: arb, sites: int) -> arb:
    """Return C_N."""
    return 4 * sites * (k.extent + (k.extent * k.extent + h / (2 * sites)).sqrt())


def threshold(k: Parameters, sites: int | None) -> arb:
    """Return gamma_0 of a chain at rest beyond its ends, or of the infinite one."""
    if sites is None:
        band = (arb.min(arb(0), 4 * k.epsilon), arb.max(arb(0), 4 * k.epsilon))
        return arb.max(arb(0), arb.max(band[0] - k.omega, k.omega - band[1])) / 2
    waves = (arb(n) / (2 * sites + 2) for n in range(1, sites + 1))
    distances = (abs(4 * k.epsilon * x.sin_pi() * x.sin_pi() - k.omega) / 2 for x in waves)
    return reduce(arb.min, distances)


def coercivity(k: Parameters, p: arb) -> arb:
    """Return g(P), the lower bound of -H with the bonds kept (see `models.bounds.coercivity`)."""
    cubic = p * p / (64 * k.epsilon)
    s = arb.min(arb(1), 2 * k.gamma / (3 * cubic))
    return p * (abs(k.omega) - k.gamma * (1 + s) - cubic * (1 - 3 * s * s / 4))


def top(k: Parameters) -> arb:
    """Return the P at which g is largest; Theorem 2 must apply and epsilon be positive."""
    if 2 * k.gap <= k.gamma:
        return (256 * k.epsilon * k.gap / 3).sqrt()
    m = abs(k.omega) - k.gamma
    return (32 * k.epsilon / 3 * (m + (m * m + 4 * k.gamma * k.gamma).sqrt())).sqrt()


def widened(k: Parameters, depth: arb) -> arb | None:
    """Return the smaller root of g(P) = `depth`, or None if g does not reach it."""
    highest = top(k).lower()
    low, high = arb(0), highest
    if not (coercivity(k, highest) > depth > 0):
        return None
    for _ in range(HALVINGS):
        middle = ((low + high) / 2).mid()
        value = coercivity(k, middle)
        if value < depth:
            low = middle
        elif value > depth:
            high = middle
        else:  # as near as the precision tells
            break
    return low.union(high)


class Enclosed(NamedTuple):
    """One constant: where the study of the theory keeps it, under which name, and its ball."""

    dataset: str
    variable: str
    of: Mapping[str, str | float | int]  # coordinates of the value in the dataset
    ball: arb

    @property
    def label(self) -> str:
        """The constant as the report shows it."""
        of = (f"{key} {value:g}" if key != "case" else str(value) for key, value in self.of.items())
        return f"{self.variable} of {', '.join(of)}" if self.of else self.variable


def _enclosed(dataset: str, of: Mapping, values: Mapping[str, arb | None]) -> list[Enclosed]:
    return [Enclosed(dataset, name, of, x) for name, x in values.items() if x is not None]


def of_cases(problems: Mapping[str, Problem]) -> list[Enclosed]:
    """Enclose the bounds on the paper's cases, those that are finite."""
    found = []
    for case, problem in problems.items():
        given, sites = Parameters.of(problem.constants), 2 * problem.half_width + 1
        h, k = energy(given, problem.boundary, problem.amplitudes), given.of_theorems
        values = {"energy": h, "start": power(problem.amplitudes)}
        values["theorem_3"] = theorem_3(k, h, sites)
        above = k.omega - 2 * k.gamma - 4 * k.epsilon
        if above > 0:
            values["theorem_1"] = h / above
        if k.gap > 0:
            values |= {"delta_0": k.gap * k.gap / k.extent, "c_0": 2 * k.extent / k.gap}
            at_rest = kind_of(problem.boundary) == DIRICHLET
            if at_rest and k.epsilon > 0 and values["start"] < top(k):
                values["widened"] = widened(k, -h)
        found += _enclosed("checks/cases", {"case": case}, values)
    return found


def of_region(constants: Constants, pair: Sequence, sites: int) -> list[Enclosed]:
    """Enclose the regions that Theorem 2 covers, as proved and with the bonds kept."""
    given, amplitudes = Parameters.of(constants), np.zeros((2, sites), complex)
    amplitudes[:, sites // 2] = [complex(one) for one in pair]
    h, k = energy(given, "dirichlet", amplitudes), given.of_theorems
    values = {"start": power(amplitudes), "depth": -h}
    if k.gap > 0 and k.epsilon > 0:
        barrier = coercivity(k, top(k))
        values |= {
            "barrier": k.gap * k.gap,
            "delta_0": k.gap * k.gap / k.extent,
            "c_0": 2 * k.extent / k.gap,
            "widened_barrier": barrier,
            "widened_delta_0": arb.min(top(k), barrier / k.extent),
            "widened_bound": widened(k, -h),
        }
    return _enclosed("checks/theorem_2_case", {}, values)


def of_printed_constant(constants: Constants, amplitude: float, longest: int) -> list[Enclosed]:
    """Enclose H minus the bound of Theorem 3's proof on A = -B = x (-1)^n, and where it fails.

    With gamma in the bound, as printed, it is negative from some number of sites on; with 2 gamma
    it is not. Both follow from the signs of balls.
    """
    k, x = Parameters.of(constants), balls.decimal(amplitude)
    found, failing = [], []
    for sites in range(1, longest + 1, 2):
        wave = amplitude * (1.0 - 2.0 * (np.arange(sites) % 2))
        h = energy(k, "dirichlet", np.stack([wave, -wave]).astype(complex))
        quartic = sites * x * x * x * x  # of each component
        for name, drive in (("printed", 1), ("corrected", 2)):
            constant = abs(k.omega) + drive * k.gamma + 4 * k.epsilon
            margin = h - (quartic / 2 - 2 * constant * arb(sites).sqrt() * quartic.sqrt())
            found.append(Enclosed("checks/theorem_3_constant", name, {"sites": sites}, margin))
            if name == "printed" and margin < 0:
                failing.append(sites)
    smallest = arb(min(failing, default=0))
    return [*found, Enclosed("checks/theorem_3_constant", "smallest", {}, smallest)]


def of_thresholds(check: str, epsilon: float, omegas: Iterable, sites: int) -> list[Enclosed]:
    """Enclose gamma_0 of N sites, and of the infinite chain or by how much it is smaller there."""
    found = []
    for omega in map(float, omegas):
        k = Parameters.of(Constants(epsilon=epsilon, gamma=0.0, omega=omega))
        finite, infinite = threshold(k, sites), threshold(k, None)
        if check == "chart":
            values = {"finite_threshold": finite, "infinite_threshold": infinite}
        else:
            values = {"threshold": finite, "finite_gap": finite - infinite}
        found += _enclosed(f"checks/{check}", {"omega": omega}, values)
    return found


def farthest(ball: arb, stored: float) -> float:
    """Return a bound of the distance of a double from the true number.

    It is relative to the true number where that is known to be above one.
    """
    if not np.isfinite(stored):
        return np.inf
    size = abs(ball)
    return balls.upper(abs(arb(stored) - ball) / (size if size > 1 else arb(1)))


def enclose_checks(
    problems: Mapping[str, Problem], theory: Mapping[str, Mapping], datasets: Mapping
) -> Contents:
    """Return each constant as stored, between the doubles that its ball lies between.

    `theory` has the arguments of the checks `theorem_2_case`, `theorem_3_constant`, `threshold` and
    `chart` as the configuration states them, and `datasets` what they stored. Other boundary
    conditions than Dirichlet's change the chart's thresholds, which are then left out.
    """
    region, printed = theory["theorem_2_case"], theory["theorem_3_constant"]
    waves, chart = theory["threshold"], theory["chart"]
    with balls.precision():
        found = [
            *of_cases(problems),
            *of_region(Constants.of(region["constants"]), region["pair"], region["sites"]),
            *of_printed_constant(
                Constants.of(printed["constants"]), printed["amplitude"], printed["longest"]
            ),
            *of_thresholds("threshold", waves["epsilon"], waves["omegas"], waves["sites"]),
        ]
        if kind_of(chart["boundary"]) == DIRICHLET:
            grid = chart["omegas"]
            omegas = np.linspace(grid["first"], grid["last"], grid["points"])
            found += of_thresholds("chart", chart["epsilon"], omegas, chart["sites"])
        kept = [datasets[one.dataset.removeprefix("checks/")][one.variable] for one in found]
        stored = [
            float(data.sel(dict(one.of)).item()) for one, data in zip(found, kept, strict=True)
        ]
        off = [farthest(one.ball, value) for one, value in zip(found, stored, strict=True)]
        lows, highs = ([end(one.ball) for one in found] for end in (balls.lower, balls.upper))
    of = ("constant",)
    variables = {
        "constant": Variable(of, [f"{one.dataset}: {one.label}" for one in found], "constant"),
        "stored": Variable(of, stored, "the constant as the study of the theory stored it"),
        "lower": Variable(of, lows, "lower bound of the constant"),
        "upper": Variable(of, highs, "upper bound of the constant"),
        "stored_error": Variable(
            of,
            off,
            "bound of the stored number's distance from the constant, relative above one",
        ),
    }
    return variables, {"title": "Constants of the theorems in balls", "bits": balls.BITS}
