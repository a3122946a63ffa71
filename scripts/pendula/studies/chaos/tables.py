"""The datasets of chaos: what is measured of each case, as variables with names and units."""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.measures.growth import is_chaotic, mean_rate, mean_rate_error
from pendula.problem import Problem

from . import divergence
from .cases import describe_cases
from .changes import PARITIES
from .lyapunov import follow_all, follow_parity

RATE = "tau-1"
SAMPLED = 4  # every so many orthonormalisations the spectrum on its way is kept


def _coordinates(**names: tuple) -> dict[str, Variable]:
    return {name: Variable((name,), values, title) for name, (values, title) in names.items()}


def largest_exponents(problems: dict[str, Problem], end_time: float) -> dict[str, Variable]:
    """Return the growth of an even and of an odd change of each case, and its mean rate.

    `problems` are given by case; rates are over the second half of time.
    """
    runs = [[follow_parity(p, parity, end_time) for parity in PARITIES] for p in problems.values()]
    amplified = [divergence.amplification(even.tau, even.stretch[0], even.size) for even, _ in runs]
    rates = [[mean_rate(run.tau, run.stretch[0], end_time / 2) for run in pair] for pair in runs]
    errors = [
        [mean_rate_error(run.tau, run.stretch[0], end_time / 2) for run in pair] for pair in runs
    ]
    chaotic = [any(is_chaotic(run.tau, run.stretch[0], run.size) for run in pair) for pair in runs]
    by_parity, series = ("case", "parity"), ("case", "parity", "tau")
    stretch = [[run.stretch[0] for run in pair] for pair in runs]
    return {
        **describe_cases(problems),
        **_coordinates(
            parity=(list(PARITIES), "parity of the change in n"),
            tau=(runs[0][0].tau, "slow time"),
        ),
        "stretch": Variable(series, stretch, "logarithm of the growth of a small change"),
        "size": Variable(
            ("case", "tau"), [even.size for even, _ in runs], "l2 norm of the solution"
        ),
        "amplification": Variable(
            ("case", "tau"), amplified, "logarithm of relative error per error made a unit of tau"
        ),
        "exponent": Variable(by_parity, rates, "largest Lyapunov exponent", RATE),
        "exponent_error": Variable(by_parity, errors, "standard error of the exponent", RATE),
        "chaotic": Variable(
            ("case",), np.array(chaotic, int), "one where a small change grows exponentially"
        ),
    }


def divergence_times(problems: dict[str, Problem], tolerances, growth: dict) -> dict[str, Variable]:
    """Return the divergence times of dop853 at each tolerance, predicted and measured.

    `growth` is what `largest_exponents` returned; predictions use its amplification of errors,
    of the tolerance at each step or of the errors that the run is seen to make up to EARLY.
    """
    tau, amplified = growth["tau"].values, growth["amplification"].values
    early = divergence.early_index(tau)
    bound, seen, measured, rounding = [], [], [], []
    for problem, log in zip(problems.values(), amplified, strict=True):
        found = divergence.measure(problem, tolerances)
        made = found.early / np.exp(log[early])
        bound.append([divergence.predict(tau, log, e) for e in tolerances * found.steps])
        seen.append([divergence.predict(tau, log, e) for e in made])
        measured.append(found.time)
        rounding.append(divergence.predict(tau, log, divergence.ROUNDING))
    grid = ("case", "rtol")
    return {
        **_coordinates(rtol=(np.asarray(tolerances), "tolerance of dop853")),
        "divergence_bound": Variable(
            grid, bound, "divergence time with the tolerance made at each step", "tau"
        ),
        "divergence_predicted": Variable(
            grid, seen, "divergence time predicted from errors made early", "tau"
        ),
        "divergence_measured": Variable(
            grid, measured, "divergence time from a run at 1e-15", "tau"
        ),
        "divergence_rounding": Variable(
            ("case",), rounding, "divergence time by one rounding a unit of tau", "tau"
        ),
    }


def spectra(problems: dict[str, Problem], end_time: float) -> dict[str, Variable]:
    """Return all exponents of the cases, on their way and over the last three quarters of time."""
    runs = [follow_all(problem, end_time) for problem in problems.values()]
    tau = runs[0].tau[SAMPLED::SAMPLED]
    running = [run.stretch[:, SAMPLED::SAMPLED] / tau for run in runs]
    rates = [mean_rate(run.tau, run.stretch, end_time / 4) for run in runs]
    errors = [mean_rate_error(run.tau, run.stretch, end_time / 4) for run in runs]
    grid = ("spectrum_case", "index")
    return {
        **_coordinates(
            spectrum_case=(list(problems), "case whose spectrum is found, on a short chain"),
            index=(np.arange(1, 1 + len(rates[0])), "number of the exponent"),
            spectrum_tau=(tau, "slow time"),
        ),
        "running_spectrum": Variable(
            (*grid, "spectrum_tau"), running, "mean rates of growth since the start", RATE
        ),
        "spectrum": Variable(grid, rates, "Lyapunov exponents of a short chain", RATE),
        "spectrum_error": Variable(grid, errors, "standard error of these exponents", RATE),
    }
