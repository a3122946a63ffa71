"""Ensembles of long runs on chains without ends: their datasets, how norms grow, and maps.

Where the chain at rest is unstable, a front moves at the speed v of linear spreading and leaves a
thermal bulk of mean power P per site on both sides. The norm is then l2 = (2 v P tau)^(1/2).
"""

from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import Variable, as_xarray
from pendula.datasets.registry import NAMES
from pendula.datasets.trajectories import Contents, describe_run, shared_by
from pendula.measures.confidence import mean_limits
from pendula.measures.growth import local_exponents
from pendula.numerics.draws import normal
from pendula.numerics.elementary import geometric, interpolated, log, modulus
from pendula.problem import Problem

from .active_sites import LEVELS, LongRun, run_chains, run_long
from .bulk import FIRST_OF_LINE, NEIGHBOURS, POWER, TERMS, thermal_powers
from .extremes import mean_maximum
from .front import (
    DELAY,
    PIECE_TAU,
    PREDICTED_SPEED,
    PULLED,
    REST,
    SITE_OF_FRONT,
    is_unstable,
    linear_front,
)


class Ensemble(NamedTuple):
    """How the members of an ensemble are made."""

    members: int
    perturbation: float
    """Relative size of the differences: chaos makes them of order one in some ten units of tau."""
    seed: int


def member(initial: np.ndarray, ensemble: Ensemble, number: int) -> np.ndarray:
    """Return the initial data of an ensemble's member; number 0 has the data as they are.

    All sites of a component share a factor, so that even data stay even.
    """
    if number == 0:
        return initial
    draws = normal(np.random.default_rng([ensemble.seed, number]), 2)
    factors = 1.0 + ensemble.perturbation * draws
    return initial * factors[:, None]


def attributes(
    title: str, name: str, problems: list[Problem], rest: float, ensemble: Ensemble
) -> dict:
    """Return what all of `problems` have in common: of varied parameters there is no one value."""
    described = [describe_run(name, problem, problem.solver) for problem in problems]
    shared = shared_by(described, "half_width", "snapshot_every")
    ends = {"boundary": "none: sites are added as the front moves", "rest": rest}
    return {"title": title, **shared, **ends, **ensemble._asdict()}


def run_variables(problems: list[Problem], runs: list[list[LongRun]]) -> dict[str, Variable]:
    """Return the variables of `runs` [variant][member] of as many problems."""
    first = runs[0][0]
    predicted = [linear_front(problem.constants) for problem in problems]

    def of_variants(values: list[float], long_name: str = "") -> Variable:
        return Variable(("variant",), np.array(values, float), long_name)

    def series(name: str, axes: tuple, long_name: str = "") -> Variable:
        values = [[getattr(run, name) for run in members] for members in runs]
        return Variable(("variant", "member", *axes), np.array(values), long_name)

    return {
        "tau": Variable(("tau",), first.tau),
        "piece_tau": Variable(("piece_tau",), first.piece_tau, PIECE_TAU),
        "front_power": Variable(("front_power",), LEVELS, "power P at which the front is found"),
        "omega": of_variants([p.constants.omega for p in problems]),
        "central_modulus": of_variants([_central(p) for p in problems], "initial |A_0|"),
        "tolerance": of_variants([p.solver["rtol"] for p in problems], "tolerance of the solver"),
        "l2": series("l2", ("tau",), f"{NAMES['l2']}, of A and B together"),
        "linf": series("linf", ("tau",), f"{NAMES['linf']}, of A and B together"),
        "energy": series("energy", ("tau",)),
        "front": series("front", ("piece_tau", "front_power"), SITE_OF_FRONT),
        "width": series("width", ("piece_tau",), "last site that is integrated, W"),
        **_bulk(np.array([[run.bulk for run in members] for members in runs])),
        "neighbours": Variable(("neighbours",), NEIGHBOURS, "neighbouring sites of a block"),
        "bulk_maximum": series(
            "maxima",
            ("piece_tau", "neighbours"),
            "largest |A_n| or |B_n| of a block, mean over the blocks of the old half of the bulk",
        ),
        "state": Variable(
            ("variant", "member", "row", "site"),
            _padded([[run.state[:, 1:-1] for run in members] for members in runs]),
            "Re A, Im A, Re B, Im B at the end, zero beyond W",
        ),
        "predicted_speed": of_variants([front.speed for front in predicted], PREDICTED_SPEED),
        "predicted_delay": of_variants([front.delay for front in predicted], DELAY),
        "predicted_rest": of_variants([front.rest for front in predicted], REST),
    }


def _bulk(means: np.ndarray) -> dict[str, Variable]:
    """Return as variables the means behind the front, (variant, member, piece, level, 5)."""
    axes = ("variant", "member", "piece_tau", "front_power")
    place = "over the bulk behind the front"
    return {
        "term": Variable(("term",), list(TERMS), "term of the energy (8)"),
        "bulk_power": Variable(axes, means[..., 0], f"{POWER}, {place}"),
        "bulk_terms": Variable((*axes, "term"), means[..., 1:], f"terms of H per site, {place}"),
    }


def _central(problem: Problem) -> float:
    """Return |A_0| at the start."""
    return modulus(problem.initial[0, problem.initial.shape[1] // 2])


def _padded(states: list[list[np.ndarray]]) -> np.ndarray:
    widest = max(state.shape[1] for members in states for state in members)
    return np.array(
        [[np.pad(s, ((0, 0), (0, widest - s.shape[1]))) for s in members] for members in states]
    )


# --- Growth ---------------------------------------------------------------------------------------

POINTS, OCTAVES = 120, 4
"""Times of a series, equally spaced in log tau; the last octaves of time with an exponent each."""
BAND = ("lowest", "mean", "highest")
"""What is kept of a norm over the members of an ensemble."""


def measure_growth(runs: Mapping[str, xr.Dataset], thermal: xr.Dataset) -> xr.Dataset:
    """Return series, exponents and laws of the ensembles in `runs`, by case.

    `runs` are datasets of `run_variables`, and the first variant of each is measured. `thermal`
    holds the mean power of the thermal states over Omega. All values are dimensionless.
    """
    first = [run.isel(variant=0) for run in runs.values()]
    times = [geometric(1.0, float(run["tau"][-1]), POINTS) for run in first]
    series = {
        name: [_series(run, name, at) for run, at in zip(first, times, strict=True)]
        for name in ("l2", "linf")
    }
    local = [_exponents(run) for run in first]
    case, point, octave = ("case",), ("case", "point"), ("case", "octave")
    variables = {
        "case": Variable(case, list(runs)),
        "omega": Variable(case, [float(run["omega"]) for run in first]),
        "initial": Variable(case, [str(run.attrs["initial"]) for run in first]),
        "band": Variable(("band",), list(BAND), "value over the members of the ensemble"),
        "tau": Variable(point, times),
        **{
            name: Variable(("case", "band", "point"), values, f"{NAMES[name]}, of A and B together")
            for name, values in series.items()
        },
        "octave_tau": Variable(octave, [one[0] for one in local], "middle of an octave of tau"),
        "l2_exponent": Variable(octave, [one[1] for one in local], "exponent of tau in l2"),
        "l2_exponent_error": Variable(
            octave,
            [one[2] for one in local],
            "95 % limits of the exponent of tau in l2 by Student's t, to each side",
        ),
        "thermal_linf": Variable(
            ("case", "point"),
            [_thermal_linf(run, at, thermal) for run, at in zip(first, times, strict=True)],
            "mean of the l-infinity norm where all sites behind the front are in equilibrium",
        ),
        **_rates(first, thermal),
    }
    shared = shared_by([run.attrs for run in first])
    return as_xarray(variables, {**shared, "title": "Growth of the norms on chains without ends"})


def _series(run: xr.Dataset, name: str, times: np.ndarray) -> list[np.ndarray]:
    """Return a norm at `times`, its BAND over the members."""
    values = run[name].transpose("member", "tau").values
    drawn = np.array([interpolated(times, run["tau"].values, series) for series in values])
    return [drawn.min(axis=0), drawn.mean(axis=0), drawn.max(axis=0)]


def _thermal_linf(run: xr.Dataset, times: np.ndarray, thermal: xr.Dataset) -> np.ndarray:
    """Return the l-infinity norm of a thermal bulk as far as a pulled front is at `times`."""
    if not _is_of(thermal, run) or abs(float(run["omega"] - thermal["bound_omega"])) > 1e-9:
        return np.full(len(times), np.nan)
    passed = float(run["predicted_speed"]) * (times - _delay(run) * log(times))
    return mean_maximum(thermal, np.maximum(1.0, passed))


def _exponents(run: xr.Dataset) -> tuple[np.ndarray, ...]:
    """Return the middles of the last octaves, the exponents of l2 there, and their limits."""
    values = run["l2"].transpose("member", "tau").values
    middles, fits = local_exponents(run["tau"].values, values, OCTAVES)
    halves = [fit.half if np.isfinite(fit.half) else np.nan for fit in fits]
    return middles, np.array([fit.value for fit in fits]), np.array(halves)


# --- l2^2 against the law 2 v P tau ---------------------------------------------------------------

FIRST, SPANS = 10.0, 16
"""Where the comparison with the law begins, and its spans, equally long in log tau."""


def _rates(runs: list[xr.Dataset], thermal: xr.Dataset) -> dict[str, Variable]:
    """Return l2^2 / tau over spans of time and its law, in which no constant is fitted.

    Where the law begins is not known, so that an offset of l2^2 is fitted beside it.
    """
    found = [_rate(run, thermal) for run in runs]
    axes, of = ("case", "span"), "l2^2 / tau, mean over a span of time"
    banded = ("case", "band", "span")
    return {
        "span_tau": Variable(axes, [one["tau"] for one in found], "middle of a span of tau"),
        "l2_rate": Variable(banded, [one["l2_rate"] for one in found], of),
        "rate_limits": Variable(
            axes, [one["limits"] for one in found], f"half of the 95 % limits of the mean {of}"
        ),
        "law": Variable(
            ("case",), [_law(run, thermal) for run in runs],
            "2 v P: l2^2 / tau by linear spreading and the thermal bulk, for long times",
        ),
        "law_rate": Variable(
            axes, [one["law"] for one in found], "that law with the delay of a pulled front"
        ),
        "offset_rate": Variable(
            axes, [one["offset"] for one in found], "b / tau, with the offset b of l2^2 fitted"
        ),
    }  # fmt: skip


def _rate(run: xr.Dataset, thermal: xr.Dataset) -> dict[str, np.ndarray]:
    """Return l2^2 / tau of one ensemble over SPANS of time: its BAND, limits, and law."""
    tau = run["tau"].values
    squares = run["l2"].transpose("member", "tau").values ** 2
    edges = geometric(FIRST, float(tau[-1]), SPANS + 1)
    spans = [(tau >= a) & (tau <= b) for a, b in pairwise(edges)]
    means = np.array([(squares[:, span] / tau[span]).mean(axis=1) for span in spans])
    passed = tau - _delay(run) * log(np.maximum(tau, 1.0))
    rate = _law(run, thermal)
    law = [rate * (passed[span] / tau[span]).mean() for span in spans]
    late = tau >= FIRST_OF_LINE * tau[-1]
    offset = (squares.mean(axis=0) - rate * passed)[late].mean()
    limits = mean_limits(means.T).half
    return {
        "tau": np.sqrt(edges[:-1] * edges[1:]),
        "l2_rate": np.array([means.min(axis=1), means.mean(axis=1), means.max(axis=1)]),
        "limits": np.where(np.isfinite(limits), limits, np.nan),
        "law": np.array(law),
        "offset": np.array([offset * (1.0 / tau[span]).mean() for span in spans]),
    }


def _law(run: xr.Dataset, thermal: xr.Dataset) -> float:
    """Return 2 v P, NaN where the chain at rest is stable or no state was solved."""
    if not _is_of(thermal, run) or run["predicted_delay"] <= 0.0:
        return np.nan
    return 2.0 * float(run["predicted_speed"]) * float(thermal_powers(thermal, run["omega"].values))


def _is_of(thermal: xr.Dataset, run: xr.Dataset) -> bool:
    """Return whether thermal states over Omega were solved for the other constants of a run."""
    return all(thermal.attrs[name] == run.attrs[name] for name in ("epsilon", "gamma"))


def _delay(run: xr.Dataset) -> float:
    """Return the time that a pulled front loses per unit of log tau."""
    return float(run["predicted_delay"] / run["predicted_speed"])


# --- Maxima over [10, T] on chains of half-width M ------------------------------------------------

START = 10.0
"""Where the paper's windows begin."""


class WindowMap(NamedTuple):
    """Maxima of the pair's norms over [START, end], (half_width, end)."""

    l2: np.ndarray
    linf: np.ndarray


def window_map(
    problem: Problem, rest: float, half_widths: list[int], ends: np.ndarray
) -> WindowMap:
    """Return the maxima for each of the rising `half_widths`, for all `ends` of windows.

    See `active_sites` for `rest`.
    """
    runs = run_chains(problem, rest, half_widths)
    return WindowMap(
        np.array([maxima(run.tau, run.l2, ends) for run in runs]),
        np.array([maxima(run.tau, run.linf, ends) for run in runs]),
    )


def maxima(tau: np.ndarray, series: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return the largest value over [START, end] for each of `ends`."""
    first = np.searchsorted(tau, START - 1e-9)
    running = np.maximum.accumulate(series[first:])
    return running[np.searchsorted(tau[first:], np.asarray(ends) + 1e-9) - 1]


def map_variables(
    maps: list[WindowMap], half_widths: list[int], ends: np.ndarray, problem: Problem
) -> dict[str, Variable]:
    """Return the variables of the maps of an ensemble's members."""
    axes, speed = ("member", "half_width", "end"), linear_front(problem.constants).speed
    pulled = int(is_unstable(problem.constants))
    found = f"of A and B together, maximum over [{START:g}, end]"
    return {
        "half_width": Variable(("half_width",), np.asarray(half_widths)),
        "end": Variable(("end",), ends, "end of the time window"),
        "l2": Variable(axes, [m.l2 for m in maps], f"{NAMES['l2']}, {found}"),
        "linf": Variable(axes, [m.linf for m in maps], f"{NAMES['linf']}, {found}"),
        "predicted_speed": Variable((), speed, PREDICTED_SPEED),
        "pulled": Variable((), pulled, PULLED),
    }


# --- Jobs -----------------------------------------------------------------------------------------


def spread_case(
    name: str, problems: list[Problem], rest: float, members: int, perturbation: float, seed: int,
    checkpoints: str, step: Callable[[str], None],
) -> Contents:  # fmt: skip
    """Return the series of each problem and member; `checkpoints` is where to keep unfinished ones.

    An interrupted job continues from there, and gives the same numbers to the last bit.
    """
    runs, kept, ensemble = [], [], Ensemble(members, perturbation, seed)
    for variant, problem in enumerate(problems):
        runs.append([])
        for number in range(members):
            kept.append(Path(checkpoints, f"{name}-{variant}-{number}.npz"))
            started = problem.changed(initial=member(problem.initial, ensemble, number))
            runs[-1].append(run_long(started, rest, kept[-1] if checkpoints else None))
            step(f"{name}: member {number + 1} of {members} of problem {variant + 1} done")
    return run_variables(problems, runs), attributes(
        f"Norms, front and final states of {name} on chains without ends",
        *(name, problems, rest, ensemble),
    )


def map_windows(
    name: str, problem: Problem, rest: float, half_widths: list[int], members: int,
    perturbation: float, seed: int, step: Callable[[str], None],
) -> Contents:  # fmt: skip
    """Return the maxima of an ensemble for every T between 10 and the end of the runs."""
    ends = np.arange(START + 2.0, problem.end_time + 1.0, 2.0)
    maps, ensemble = [], Ensemble(members, perturbation, seed)
    for number in range(members):
        started = problem.changed(initial=member(problem.initial, ensemble, number))
        maps.append(window_map(started, rest, half_widths, ends))
        step(f"{name}: member {number + 1} of {members} done")
    title = f"Maxima of the norms over half-widths and time windows, case of {name}"
    about = attributes(title, name, [problem], rest, ensemble)
    return map_variables(maps, half_widths, ends, problem), about
