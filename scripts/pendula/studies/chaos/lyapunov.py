"""Lyapunov exponents, and the divergence times that follow from them.

A Lyapunov exponent is the mean rate at which a small perturbation of a solution grows. Those of a
Hamiltonian flow come in pairs of opposite sign, sum to zero, and two of them vanish: those along
the flow and across the energy. The growth also predicts when the errors that a solver makes become
visible, which is measured as well.
"""

from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.measures.difference import VISIBLE, first_above, norm_difference
from pendula.measures.growth import is_chaotic, mean_rate, mean_rate_error
from pendula.problem import Problem, by_site, write_initial
from pendula.simulation.lattice import find_reduction
from pendula.simulation.simulate import Trajectory, simulate

from .tangent_dynamics import PARITIES, Growth, grow, random_tangent

SEED = 20170817


def follow_parity(problem: Problem, parity: str, end_time: float, **controls) -> Growth:
    """Carry one random tangent vector of this parity along a case whose data are even.

    The kernels keep the parity to the last bit, so that the vector turns to the fastest direction
    among those of its parity. Raises ValueError where the data are not even in n.
    """
    if not find_reduction(problem.amplitudes).even:
        raise ValueError("tangent vectors keep their parity only along data that are even in n")
    rng = np.random.default_rng([SEED, PARITIES.index(parity)])
    tangent = random_tangent(problem.sites, parity, rng)
    return grow(problem, tangent[None], end_time, parity == "even", **controls)


def follow_all(problem: Problem, end_time: float, **controls) -> Growth:
    """Carry a full basis of 4 N tangent vectors along a case, for the whole spectrum."""
    rng = np.random.default_rng(SEED)
    count = 4 * problem.sites
    basis = np.array([random_tangent(problem.sites, None, rng) for _ in range(count)])
    return grow(problem, basis, end_time, **controls)


# --- Divergence -----------------------------------------------------------------------------------

ROUNDING = 2.0**-53
"""Relative error of one rounded operation in double precision."""
FINEST = 1e-15
EARLY = 2.0
"""Time at which the errors that a run makes are read off, before chaos has grown them far."""


def amplification(tau: np.ndarray, log_growth: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return log of the relative error at each tau, per relative error made in a unit of tau.

    Errors are made all along, each in proportion to the `size` of the solution at its time s, and
    grown by exp(log_growth(tau) - log_growth(s)). All arguments are (time,), as is the result.
    """
    made = np.log(size[1:] * np.diff(tau)) - log_growth[1:]
    total = np.logaddexp.accumulate(made) + log_growth[1:] - np.log(size[1:])
    return np.concatenate([[-np.inf], total])


def predict(tau: np.ndarray, log_amplification: np.ndarray, error: float) -> float:
    """Return the first tau at which `error` a unit of tau has grown to VISIBLE; inf if at none."""
    return first_above(tau, log_amplification, np.log(VISIBLE / error))


class Divergence(NamedTuple):
    """How runs at several tolerances differ from a finer one; all are (tolerance,)."""

    time: np.ndarray  # divergence time, inf where there is none
    steps: np.ndarray  # of the solver per unit of tau
    early: np.ndarray  # difference at tau = EARLY


def measure_divergence(problem: Problem, tolerances: list[float]) -> Divergence:
    """Follow a case by dop853 at each tolerance and at FINEST."""
    finest = _run(problem, FINEST)
    first = early_index(finest.tau)
    rows = []
    for tolerance in tolerances:
        run = _run(problem, tolerance)
        difference = norm_difference(run.linf, run.l2, finest.linf, finest.l2)
        steps = (run.outcome.steps + run.outcome.rejected) / run.tau[-1]
        rows.append((first_above(run.tau, difference, VISIBLE), steps, difference[first]))
    return Divergence(*np.array(rows).T)


def early_index(tau: np.ndarray) -> int:
    """Return where EARLY is among increasing times."""
    return int(np.argmin(np.abs(tau - EARLY)))


def _run(problem: Problem, tolerance: float) -> Trajectory:
    solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
    return simulate(problem.changed(solver=solver, snapshot_every=0))


# --- Datasets -------------------------------------------------------------------------------------


def describe_cases(problems: dict[str, Problem]) -> dict[str, Variable]:
    """Return names, detunings and initial data of `problems` by case."""
    omegas = [float(problem.constants.omega) for problem in problems.values()]
    initials = [write_initial(by_site(problem.initial)) for problem in problems.values()]
    return {
        "case": Variable(("case",), list(problems)),
        "omega": Variable(("case",), omegas),
        "initial": Variable(("case",), initials),
    }


SAMPLED = 4  # every so many orthonormalisations the spectrum on its way is kept


def _coordinates(**names: tuple) -> dict[str, Variable]:
    return {name: Variable((name,), values, title) for name, (values, title) in names.items()}


def largest_exponents(problems: dict[str, Problem], end_time: float) -> dict[str, Variable]:
    """Return the growth of an even and of an odd tangent vector of each case, and its mean rate.

    `problems` are given by case; rates are over the second half of time.
    """
    runs = [[follow_parity(p, parity, end_time) for parity in PARITIES] for p in problems.values()]
    amplified = [amplification(even.tau, even.log_growth[0], even.size) for even, _ in runs]
    rates = [[mean_rate(run.tau, run.log_growth[0], end_time / 2) for run in pair] for pair in runs]
    errors = [
        [mean_rate_error(run.tau, run.log_growth[0], end_time / 2) for run in pair] for pair in runs
    ]
    chaotic = [
        any(is_chaotic(run.tau, run.log_growth[0], run.size) for run in pair) for pair in runs
    ]
    by_parity, series = ("case", "parity"), ("case", "parity", "tau")
    log_growth = [[run.log_growth[0] for run in pair] for pair in runs]
    return {
        **describe_cases(problems),
        **_coordinates(
            parity=(list(PARITIES), "parity of the tangent vector in n"),
            tau=(runs[0][0].tau, "slow time"),
        ),
        "log_growth": Variable(series, log_growth, "logarithm of the growth of a tangent vector"),
        "size": Variable(
            ("case", "tau"), [even.size for even, _ in runs], "l2 norm of the solution"
        ),
        "amplification": Variable(
            ("case", "tau"), amplified, "logarithm of relative error per error made a unit of tau"
        ),
        "exponent": Variable(by_parity, rates, "largest Lyapunov exponent, per unit of tau"),
        "exponent_error": Variable(by_parity, errors, "standard error of the exponent"),
        "chaotic": Variable(
            ("case",), np.array(chaotic, int), "one where tangent vectors grow exponentially"
        ),
    }


def divergence_times(problems: dict[str, Problem], tolerances, growth: dict) -> dict[str, Variable]:
    """Return the divergence times of dop853 at each tolerance, predicted and measured.

    `growth` is what `largest_exponents` returned; predictions use its amplification of errors,
    of the tolerance at each step or of the errors that the run is seen to make up to EARLY.
    """
    tau, amplified = growth["tau"].values, growth["amplification"].values
    early = early_index(tau)
    bound, seen, measured, rounding = [], [], [], []
    for problem, log in zip(problems.values(), amplified, strict=True):
        found = measure_divergence(problem, tolerances)
        made = found.early / np.exp(log[early])
        bound.append([predict(tau, log, e) for e in tolerances * found.steps])
        seen.append([predict(tau, log, e) for e in made])
        measured.append(found.time)
        rounding.append(predict(tau, log, ROUNDING))
    grid = ("case", "rtol")
    return {
        **_coordinates(rtol=(np.asarray(tolerances), "tolerance of dop853")),
        "divergence_bound": Variable(
            grid, bound, "divergence time with the tolerance made at each step"
        ),
        "divergence_predicted": Variable(
            grid, seen, "divergence time predicted from errors made early"
        ),
        "divergence_measured": Variable(grid, measured, "divergence time from a run at 1e-15"),
        "divergence_rounding": Variable(
            ("case",), rounding, "divergence time by one rounding a unit of tau"
        ),
    }


def spectra(problems: dict[str, Problem], end_time: float) -> dict[str, Variable]:
    """Return all exponents of the cases, on their way and over the last three quarters of time."""
    runs = [follow_all(problem, end_time) for problem in problems.values()]
    tau = runs[0].tau[SAMPLED::SAMPLED]
    running = [run.log_growth[:, SAMPLED::SAMPLED] / tau for run in runs]
    rates = [mean_rate(run.tau, run.log_growth, end_time / 4) for run in runs]
    errors = [mean_rate_error(run.tau, run.log_growth, end_time / 4) for run in runs]
    grid = ("spectrum_case", "index")
    return {
        **_coordinates(
            spectrum_case=(list(problems), "case whose spectrum is found, on a short chain"),
            index=(np.arange(1, 1 + len(rates[0])), "number of the exponent"),
            spectrum_tau=(tau, "slow time"),
        ),
        "running_spectrum": Variable(
            (*grid, "spectrum_tau"),
            running,
            "mean rates of growth since the start, per unit of tau",
        ),
        "spectrum": Variable(grid, rates, "Lyapunov exponents of a short chain, per unit of tau"),
        "spectrum_error": Variable(grid, errors, "standard error of these exponents"),
    }
