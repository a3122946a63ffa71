"""Lyapunov exponents, and the divergence times that follow from them.

A Lyapunov exponent is the mean rate at which a small perturbation of a solution grows. Those of a
Hamiltonian flow come in pairs of opposite sign, sum to zero, and two of them vanish: those along
the flow and across the energy. The growth also predicts when the errors that a solver makes become
visible, which is measured as well.
"""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.measures.confidence import Limits, student
from pendula.measures.difference import VISIBLE, first_above, norm_difference
from pendula.measures.growth import PARTS, is_chaotic, mean_rate, mean_rate_error
from pendula.numerics.draws import complex_normal
from pendula.numerics.elementary import exp, log
from pendula.problem import Problem
from pendula.simulation.lattice import find_reduction
from pendula.simulation.simulate import simulate

from .tangent_dynamics import Growth, grow

PARITIES = ("even", "odd")


def random_tangent(sites: int, parity: str | None, rng: np.random.Generator) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N), of the parity asked for to the last bit."""
    z = complex_normal(rng, (2, sites))
    return {None: z, "even": z + z[:, ::-1], "odd": z - z[:, ::-1]}[parity]


def follow_parity(problem: Problem, parity: str, end_time: float, seed: int, **controls) -> Growth:
    """Carry one random tangent vector of this parity along a case.

    Along even data the kernels keep the parity to the last bit, so that the vector turns to the
    fastest direction among those of its parity. Along others it turns to the fastest of all.
    """
    rng = np.random.default_rng([seed, PARITIES.index(parity)])
    tangent = random_tangent(problem.sites, parity, rng)
    half = parity == "even" and find_reduction(problem.amplitudes).even
    return grow(problem, tangent[None], end_time, half, **controls)


def follow_many(problem: Problem, count: int, end_time: float, seed: int, **controls) -> Growth:
    """Carry `count` tangent vectors along a case, which has 4 N of them, for the largest exponents.

    Each vector loses its components along those before it, so that a larger `count` changes none
    but by the steps that the solver takes.
    """
    rng = np.random.default_rng(seed)
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
    made = log(size[1:] * np.diff(tau)) - log_growth[1:]
    peak = np.maximum.accumulate(made)
    kept = [exp(made[: i + 1] - top).sum() for i, top in enumerate(peak)]
    total = peak + log(np.array(kept)) + log_growth[1:] - log(size[1:])
    return np.concatenate([[-np.inf], total])


def predict(tau: np.ndarray, log_amplification: np.ndarray, error: float) -> float:
    """Return the first tau at which `error` a unit of tau has grown to VISIBLE; inf if at none."""
    return first_above(tau, log_amplification, log(VISIBLE / error))


def measure_divergence(problem: Problem, tolerances: list[float]) -> tuple[np.ndarray, np.ndarray]:
    """Return by tolerance when dop853 has diverged from another method at FINEST, and how far.

    The times are infinite where the runs do not diverge; the differences are those at EARLY.
    """
    finest, *runs = (
        simulate(
            problem.changed(solver={"name": name, "rtol": rtol, "atol": rtol}, snapshot_every=0),
            energy=False,
        )
        for name, rtol in [("taylor", FINEST), *(("dop853", each) for each in tolerances)]
    )
    apart = [norm_difference(run.linf, run.l2, finest.linf, finest.l2) for run in runs]
    early = np.array([one[early_index(finest.tau)] for one in apart])
    return first_above(finest.tau, np.array(apart), VISIBLE), early


def early_index(tau: np.ndarray) -> int:
    """Return where EARLY is among increasing times."""
    return int(np.argmin(np.abs(tau - EARLY)))


# --- Datasets -------------------------------------------------------------------------------------


def largest_exponents(problems: dict[str, Problem], end_time: float, seed: int) -> Contents:
    """Return the growth of an even and of an odd tangent vector of each case, and its mean rate.

    `problems` are given by case, and integrated at the tolerance of their solver; rates are over
    the second half of time.
    """
    runs = [
        [
            follow_parity(p, parity, end_time, seed, tolerance=p.solver["rtol"])
            for parity in PARITIES
        ]
        for p in problems.values()
    ]
    tau, middle = runs[0][0].tau, end_time / 2
    log_growth = np.array([[run.log_growth[0] for run in pair] for pair in runs])
    l2 = np.array([[run.size for run in pair] for pair in runs])
    # one at a time, since NumPy adds in another order along an axis of more
    errors = np.apply_along_axis(lambda one: mean_rate_error(tau, one, middle), -1, log_growth)
    chaotic = is_chaotic(tau, log_growth, l2).any(axis=1).astype(int)
    by_parity, parity = ("case", "parity"), "parity of the tangent vector in n"
    if not all(find_reduction(p.amplitudes).even for p in problems.values()):
        parity += ", which uneven data do not keep"
    described, shared = describe_cases(problems)
    variables = {
        **described,
        "parity": Variable(("parity",), list(PARITIES), parity),
        "tau": Variable(("tau",), tau),
        "log_growth": Variable(
            (*by_parity, "tau"), log_growth, "logarithm of the growth of a tangent vector"
        ),
        "l2": Variable(("case", "tau"), l2[:, 0], "l2 norm over the chain, of A and B together"),
        "exponent": Variable(
            by_parity, mean_rate(tau, log_growth, middle),
            "largest Lyapunov exponent, per unit of tau",
        ),
        "exponent_error": Variable(by_parity, errors, "standard error of the exponent"),
        "chaotic": Variable(("case",), chaotic, "one where tangent vectors grow exponentially"),
    }  # fmt: skip
    title = "Lyapunov exponents of the cases, and when runs leave the solution"
    return variables, {"title": title, **shared, "end_time": end_time, "seed": seed}


def divergence_times(problems: dict[str, Problem], tolerances, growth: dict) -> dict[str, Variable]:
    """Return the divergence times of dop853 at each tolerance, predicted and measured.

    `growth` holds the variables of `largest_exponents`. Errors are predicted to grow as the even
    tangent vector does, those that the run is seen to make up to EARLY or those of rounding.
    """
    tau, even = growth["tau"].values, growth["log_growth"].values[:, PARITIES.index("even")]
    early = early_index(tau)
    seen, measured, rounding = [], [], []
    for problem, log_growth, l2 in zip(problems.values(), even, growth["l2"].values, strict=True):
        amplified = amplification(tau, log_growth, l2)
        times, apart = measure_divergence(problem, tolerances)
        seen.append([predict(tau, amplified, made) for made in apart / exp(amplified[early])])
        measured.append(times)
        rounding.append(predict(tau, amplified, ROUNDING))
    grid = ("case", "rtol")
    return {
        "rtol": Variable(("rtol",), np.asarray(tolerances), "tolerance of dop853"),
        "divergence_predicted": Variable(
            grid, seen, "divergence time predicted from errors made early"
        ),
        "divergence_measured": Variable(grid, measured, "divergence time from a run at 1e-15"),
        "divergence_rounding": Variable(
            ("case",), rounding, "divergence time by one rounding a unit of tau"
        ),
    }


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
    errors, vanishing = rates.copy(), np.zeros(rates.shape[:2], int)
    for i, problem in enumerate(problems.values()):
        chains = [problem.changed(half_width=half_width) for half_width in end_times]
        chains.append(problem.changed(half_width=min(end_times), gamma=0.0))
        for j, (chain, end_time) in enumerate(zip(chains, ends, strict=True)):
            count, tolerance = 4 * chain.sites, chain.solver["rtol"]
            run = follow_many(chain, count // 2, end_time, seed, tolerance=tolerance)
            found = in_pairs(spectrum_of(run, end_time / 4))
            rates[i, j, :count], errors[i, j, :count] = found.value, found.half
            vanishing[i, j] = ((found.low <= 0.0) & (found.high >= 0.0)).sum()
    case, chain, index = ("spectrum_case", "spectrum_half_width", "index")
    words = "all Lyapunov exponents of a short chain, per unit of tau"
    alone = "all Lyapunov exponents of the shortest chain at gamma = 0, per unit of tau"
    half = "half of the confidence interval"
    return {
        case: Variable((case,), list(problems), "case, on a short chain"),
        chain: Variable((chain,), list(end_times), "half-width of the short chain"),
        index: Variable((index,), np.arange(1, 1 + most), "number of the exponent"),
        "spectrum_end_time": Variable(
            (chain,), ends[:-1], "end time of the runs on the short chain"
        ),
        "exponents": Variable((case, chain, index), rates[:, :-1], words),
        "exponents_error": Variable((case, chain, index), errors[:, :-1], f"{words}: {half}"),
        "vanishing": Variable(
            (case, chain), vanishing[:, :-1], "exponents that cannot be told from zero"
        ),
        "exponents_undriven": Variable((case, index), rates[:, -1], alone),
        "exponents_error_undriven": Variable((case, index), errors[:, -1], f"{alone}: {half}"),
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
    problems: dict[str, Problem],
    end_time: float,
    tolerances: list[float],
    short_problems: dict[str, Problem],
    short_end_times: dict[int, float],
    undriven_end: float,
    seed: int,
) -> Contents:
    """Return exponents of `problems` to `end_time`, and all exponents on short chains.

    `short_end_times` gives the end time for each half-width. The shortest chain is also followed
    without a drive, to `undriven_end`. `seed` draws the tangent vectors.
    """
    growth, attributes = largest_exponents(problems, end_time, seed)
    times = divergence_times(problems, tolerances, growth)
    short = spectra(short_problems, short_end_times, undriven_end, seed)
    return growth | times | short, attributes
