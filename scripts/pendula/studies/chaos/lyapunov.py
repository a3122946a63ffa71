"""Lyapunov exponents: how fast small perturbations of a solution grow, on average over a time span.

The largest exponent of a case is that of random tangent vectors along an ensemble of its runs: its
limits are Student's t over the members. On the span of the paper's figures the motion may not have
filled the chain yet, so that exponents differ from those of later spans.

All exponents are computed on short chains. Those of a Hamiltonian flow come in pairs of opposite
sign, sum to zero, and two of them vanish: those along the flow and across the energy.
"""

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.localised.tangents import Growth, grow, random_tangent
from latticode.measures.confidence import Limits, mean_limits, student
from latticode.measures.growth import PARTS, is_chaotic, mean_rate, mean_rate_error
from latticode.simulation.ensembles import draw_members
from latticode.simulation.problem import name_window

from pendula.many_cases import describe_cases
from pendula.problem import Problem

Span = tuple[float, float]
STEP = 1.0
"""Units of tau between two values of a growth that is kept."""


def follow_members(
    problem: Problem, end_time: float, members: int, size: float, seed: int
) -> list[Growth]:
    """Carry a random tangent vector along each of `members` runs from perturbed data."""
    tolerance, found = problem.solver["rtol"], []
    for number, member in enumerate(draw_members(problem, size, members, seed)):
        tangent = random_tangent(problem.sites, np.random.default_rng([seed, number]))
        found.append(grow(member, tangent[None], end_time, step=STEP, tolerance=tolerance))
    return found


def largest_exponents(
    problems: dict[str, Problem], spans: list[Span], members: int, size: float, seed: int
) -> Contents:
    """Return the growth of tangent vectors along members of each case, and its mean rates.

    `problems` are given by case, and integrated at the tolerance of their solver up to the end of
    the last of the `spans`.
    """
    end_time = max(end for _, end in spans)
    runs = [follow_members(one, end_time, members, size, seed) for one in problems.values()]
    tau = runs[0][0].tau
    log_growth = np.array([[run.log_growth[0] for run in some] for some in runs])
    l2 = np.array([[run.size for run in some] for some in runs])
    found = [[_exponent(tau, one, span) for span in spans] for one in log_growth]
    value, low, high = np.moveaxis(np.array(found), -1, 0)
    described, shared = describe_cases(problems)
    by_member, by_span = ("case", "member", "tau"), ("case", "span")
    says = "exponent of Lyapunov, the largest on the span, per unit of tau"
    variables = {
        **described,
        "span": Variable(("span",), [name_window(span) for span in spans], "span of time"),
        "tau": Variable(("tau",), tau),
        "log_growth": Variable(by_member, log_growth, "logarithm of a tangent vector's growth"),
        "l2": Variable(by_member, l2, "l2 norm over the chain, of A and B together"),
        "exponent": Variable(by_span, value, says),
        "exponent_low": Variable(by_span, low, f"{says}, lower confidence limit"),
        "exponent_high": Variable(by_span, high, f"{says}, upper confidence limit"),
        "chaotic": Variable(
            ("case",), is_chaotic(tau, log_growth, l2).any(axis=1).astype(int),
            "one where tangent vectors grow exponentially",
        ),
    }  # fmt: skip
    about = {"end_time": end_time, "perturbation": size, "members": members, "seed": seed}
    return variables, {"title": "Lyapunov exponents of the cases", **shared, **about}


def _exponent(tau: np.ndarray, log_growth: np.ndarray, span: Span) -> Limits:
    """Return the mean rate on a span of growths (member, time), with its limits."""
    start, end = span
    until = tau <= end
    return mean_limits(mean_rate(tau[until], log_growth[:, until], start))


def follow_many(problem: Problem, count: int, end_time: float, seed: int, **controls) -> Growth:
    """Carry `count` tangent vectors along a case, which has 4 N of them, for the largest exponents.

    Each vector loses its components along those before it, so that a larger `count` changes none
    but by the steps that the solver takes.
    """
    rng = np.random.default_rng(seed)
    basis = np.array([random_tangent(problem.sites, rng) for _ in range(count)])
    return grow(problem, basis, end_time, **controls)


def spectra(
    problems: dict[str, Problem], end_times: dict[int, float], undriven_end: float, seed: int
) -> dict[str, Variable]:
    """Return all exponents of the cases on chains of each half-width in `end_times`.

    Rates are over the last three quarters of time, their errors from parts of that time. Half of
    the exponents are measured: the others are the same with the opposite sign. Shorter
    chains have fewer exponents, so that their rows end in NaN. The shortest chain is followed
    without a drive to `undriven_end` too, where the l2 norm is a second integral.
    """
    most = 4 * (2 * max(end_times) + 1)
    ends = [*end_times.values(), undriven_end]  # the last row is that without a drive
    rates = np.full((len(problems), len(ends), most), np.nan)
    errors = rates.copy()
    for i, problem in enumerate(problems.values()):
        chains = [problem.changed(half_width=half_width) for half_width in end_times]
        chains.append(problem.changed(half_width=min(end_times), gamma=0.0))
        for j, (chain, end_time) in enumerate(zip(chains, ends, strict=True)):
            count, tolerance = 4 * chain.sites, chain.solver["rtol"]
            run = follow_many(chain, count // 2, end_time, seed, tolerance=tolerance)
            found = in_pairs(spectrum_of(run, end_time / 4))
            rates[i, j, :count], errors[i, j, :count] = found.value, found.half
    case, chain, index = ("spectrum_case", "spectrum_half_width", "index")
    words = "all Lyapunov exponents of a short chain, per unit of tau"
    alone = "all Lyapunov exponents of the shortest chain at gamma = 0, per unit of tau"
    half, end = "half of the confidence interval", "; NaN: beyond the last of a shorter chain"
    return {
        case: Variable((case,), list(problems), "case, on a short chain"),
        chain: Variable((chain,), list(end_times), "half-width of the short chain"),
        index: Variable((index,), np.arange(1, 1 + most), "number of the exponent"),
        "exponents": Variable((case, chain, index), rates[:, :-1], words + end),
        "exponents_error": Variable((case, chain, index), errors[:, :-1], f"{words}: {half}{end}"),
        "exponents_undriven": Variable((case, index), rates[:, -1], alone + end),
        "exponents_error_undriven": Variable((case, index), errors[:, -1], f"{alone}: {half}{end}"),
    }


def spectrum_of(run: Growth, start: float) -> Limits:
    """Return all exponents from `start` on, with limits by Student's t over PARTS of the time."""
    rates = mean_rate(run.tau, run.log_growth, start)
    off = student(PARTS - 1) * mean_rate_error(run.tau, run.log_growth, start)
    return Limits(rates, rates - off, rates + off)


def in_pairs(upper: Limits) -> Limits:
    """Return all exponents, in order, from the upper half: those of a Hamiltonian flow are pairs.

    The lower half has the opposite signs, since the flow keeps the symplectic product of any two
    tangent vectors.
    """
    lower = Limits(*(-values[::-1] for values in (upper.value, upper.high, upper.low)))
    return Limits(*map(np.concatenate, zip(upper, lower, strict=True)))


def measure_lyapunov(
    problems: dict[str, Problem], spans: list[Span], members: int, size: float, seed: int,
    short_problems: dict[str, Problem], short_end_times: dict[int, float], undriven_end: float,
) -> Contents:  # fmt: skip
    """Return the largest exponents of `problems` on `spans`, and all exponents on short chains.

    `short_end_times` gives the end time for each half-width. The shortest chain is also followed
    without a drive, to `undriven_end`. `seed` draws perturbations and tangent vectors.
    """
    growth, attributes = largest_exponents(problems, spans, members, size, seed)
    return growth | spectra(short_problems, short_end_times, undriven_end, seed), attributes
