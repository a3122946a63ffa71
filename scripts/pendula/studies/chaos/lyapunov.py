"""Lyapunov exponents: mean growth rates of small perturbations of a solution over a time span.

The largest exponent of a case is the growth rate of random tangent vectors along an ensemble of its
runs, with confidence limits by Student's t over the members.

The full spectrum is computed on a short chain. The exponents of a Hamiltonian flow come in pairs of
opposite sign, and two of them vanish: along the flow, and across surfaces of constant energy.
"""

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.equations.ensembles import draw_members
from latticode.localised.tangents import TangentGrowth, grow, random_tangent
from latticode.measures.confidence import mean_limits, student
from latticode.measures.growth import INTERVALS, is_chaotic, mean_rate, mean_rate_error
from replication.variables import REGULAR, SCATTERED

from pendula.many_cases import describe_cases
from pendula.problem import PaperProblem

STEP = 1.0
"""Interval between two stored values of the growth, in tau."""


def follow_members(
    problem: PaperProblem, end_time: float, members: int, size: float, seed: int
) -> list[TangentGrowth]:
    """Return the growth of a random tangent vector along each of `members` perturbed runs."""
    tolerance, growths = problem.solver["rtol"], []
    for number, member in enumerate(draw_members(problem, size, members, seed)):
        tangent = random_tangent(problem.sites, np.random.default_rng([seed, number]))
        growths.append(grow(member, tangent[None], end_time, step=STEP, tolerance=tolerance))
    return growths


def largest_exponents(
    problems: dict[str, PaperProblem],
    span: tuple[float, float],
    members: int,
    size: float,
    seed: int,
) -> Contents:
    """Return the dataset of the mean growth rates over `span` along members of each case.

    `problems` maps each case to a problem. Runs end with the span and have its solver's tolerance.
    """
    start, end_time = span
    runs = [follow_members(problem, end_time, members, size, seed) for problem in problems.values()]
    tau = runs[0][0].tau
    growth = np.array([[run.log_growth[0] for run in members_of_case] for members_of_case in runs])
    l2 = np.array([[run.size for run in members_of_case] for members_of_case in runs])
    rates = [mean_limits(mean_rate(tau, log_growth, start)) for log_growth in growth]
    described, shared = describe_cases(problems)
    long_name, over = "largest Lyapunov exponent over the span, per unit of tau", ("case",)
    variables = {
        **described,
        "exponent": Variable(over, [rate.value for rate in rates], long_name),
        "exponent_low": Variable(over, [rate.low for rate in rates], f"{long_name}, lower limit"),
        "exponent_high": Variable(over, [rate.high for rate in rates], f"{long_name}, upper limit"),
        "chaotic": Variable(
            over,
            is_chaotic(tau, growth, l2).any(axis=1).astype(int),
            "1 if tangent vectors grow exponentially, else 0",
        ),
    }
    attributes = {"start": start, "end_time": end_time, "perturbation": size}
    attributes |= {"members": members, "seed": seed}
    return variables, {"title": "Lyapunov exponents of the cases", **shared, **attributes}


def measure_spectrum(
    problem: PaperProblem, end_time: float, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return all exponents of a chain in order, and half of the confidence interval of each.

    Rates are means over the last three quarters of the run, with errors from INTERVALS of it. Each
    tangent vector is orthogonalised to the ones before it. The larger half of the exponents is
    measured; the smaller half has the opposite signs, because the flow conserves the symplectic
    product of any two tangent vectors.
    """
    rng = np.random.default_rng(seed)
    basis = np.array([random_tangent(problem.sites, rng) for _ in range(2 * problem.sites)])
    run = grow(problem, basis, end_time, tolerance=problem.solver["rtol"])
    rates = mean_rate(run.tau, run.log_growth, end_time / 4)
    off = student(INTERVALS - 1) * mean_rate_error(run.tau, run.log_growth, end_time / 4)
    return np.concatenate([rates, -rates[::-1]]), np.concatenate([off, off[::-1]])


def measure_lyapunov(
    problems: dict[str, PaperProblem],
    span: tuple[float, float],
    members: int,
    size: float,
    seed: int,
    short_problems: dict[str, PaperProblem],
    undriven_end: float,
) -> Contents:
    """Return the largest exponents of `problems`, and all exponents of `short_problems`.

    The short chains are also integrated without a drive, to `undriven_end`: then the l2 norm is a
    second integral. Perturbations and tangent vectors are drawn with `seed`.
    """
    variables, attributes = largest_exponents(problems, span, members, size, seed)
    driven = [
        measure_spectrum(problem, problem.end_time, seed) for problem in short_problems.values()
    ]
    undriven = [
        measure_spectrum(problem.changed(gamma=0.0), undriven_end, seed)
        for problem in short_problems.values()
    ]
    sites = next(iter(short_problems.values())).sites
    by_index, spectrum = ("spectrum_case", "index"), "all Lyapunov exponents of a short chain"
    variables |= {
        "spectrum_case": Variable(("spectrum_case",), list(short_problems), "case, on this chain"),
        "index": Variable(("index",), np.arange(1, 1 + 4 * sites), "number of the exponent"),
    }
    for name, exponents, of in (
        ("", driven, spectrum),
        ("_undriven", undriven, f"{spectrum} at gamma = 0"),
    ):
        rates, errors = map(np.array, zip(*exponents, strict=True))
        half = f"{of}: half of the confidence interval"
        regular = REGULAR if name else {}
        variables[f"exponents{name}"] = Variable(
            by_index, rates, f"{of}, per unit of tau", attributes=regular
        )
        variables[f"exponents_error{name}"] = Variable(
            by_index, errors, half, attributes=SCATTERED | regular
        )
    return variables, attributes
