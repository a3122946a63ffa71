"""Execution of a survey, and the results that are kept of each run."""

from collections.abc import Hashable, Iterator, Sequence
from functools import partial
from math import prod
from typing import Any, NamedTuple

import numpy as np

from latticode.generation.batches import make_batch, memory_of
from latticode.integrators import DONE, Outcome
from latticode.integrators.families import other_family, remark_on
from latticode.integrators.methods import METHODS
from latticode.kernels.simd import LANES
from latticode.measures.difference import VISIBLE, first_above, norm_difference
from latticode.measures.spreading import lay_line
from latticode.numerics.elementary import log

from .interrupts import interruptible
from .lattice import Reduction, aligned, unfold
from .observables import blank_record
from .problem import Problem
from .runs import Make, MakeTogether, ManyRuns, Run, reshape_runs, run_all
from .simulate import IntegrationError, Trajectory, find_obstacle, simulate
from .survey import OF_RUNS, Survey, Surveyed, fault_of_axis, names_of, names_of_axis
from .sweep import mean_of, within

MANY = 1000
"""A survey of fewer runs makes each alone: the kernel of batches takes seconds to compile."""


def run_survey(problem: Problem, survey: Survey, run: Run = run_all) -> dict[str, np.ndarray]:
    """Return the results of a survey by name, each (*survey.shape, ...).

    A failed run has NaN and the reason in "failure". A run that used another solver than the
    problem's has the reason in "remark". Prints one line about all failures, and one about all
    remarks. Raises ValueError for an unknown result or axis.
    """
    return runs_of_survey(problem, survey).make(run)


def runs_of_survey(problem: Problem, survey: Survey) -> ManyRuns:
    """Return the runs of a survey; their conclusion is the result of `run_survey`.

    Raises ValueError for an unknown result or axis.
    """
    names_of(survey)
    known = {**problem.model.parameters, **problem.parameters}
    reach, fields = problem.initial.shape[1] // 2, len(problem.initial)
    for name in (name for axis in survey.axes for name in names_of_axis(axis)):
        if fault := fault_of_axis(name, known, range(-reach, reach + 1), fields):
            raise ValueError(f"axes: {fault}")
    problems = Surveyed(problem, survey)
    return ManyRuns(problems, _make_of(survey), partial(_in_shape, problems))


def _in_shape(problems: Surveyed, table: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return the results of all runs in the survey's shape; print a line for each of KINDS."""
    texts = table.pop(TEXT)
    for kind, outcome in KINDS.items():
        chosen = np.char.startswith(texts, kind)
        if chosen.any():
            table[kind] = np.char.replace(np.where(chosen, texts, ""), f"{kind}: ", "", 1)
            first = int(chosen.argmax())
            at = problems.place_of(first)
            count = f"{chosen.sum()} of {len(problems)} runs {outcome}"
            print(f"{count}; the first, {at}: {table[kind][first]}", flush=True)
    return reshape_runs(table, problems.survey.shape)


KINDS = {
    "failure": "failed and have NaN",
    "remark": "used another solver",
    "unfinished": "are unfinished; to continue, pass the result as resume",
}
"""Printed description of runs, by the key with which their text begins."""
TEXT = "text"
"""Name of the result that has the reason of a failure or remark, else an empty text."""


# --- Runs in batches: one run in each lane of a vector (see latticode.generation.batches) ---------

MOST_SITES = 32
"""Largest number of sites in a batch: the series of a longer chain do not fit into the cache."""
FEWEST_RUNS = LANES // 2
"""Smallest number of runs in a batch, whose steps take as long as those of LANES runs."""


class NormsOfBatch(NamedTuple):
    """The norms of runs with the same output times, each row of a run as in `Trajectory`."""

    problems: list[Problem]
    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (component * run, time)
    l2: np.ndarray  # (component * run, time)

    def of_run(self, number: int) -> Trajectory:
        """Return the norms of one run, as a trajectory without fields."""
        count, nothing = len(self.problems), np.empty(0)
        linf, l2 = self.linf[number::count], self.l2[number::count]
        solver = dict(self.problems[number].solver)
        outcome = Outcome(DONE, self.tau[-1], 0, 0, 0)
        return Trajectory(self.tau, linf, l2, nothing, nothing, outcome, solver)


def norms_in_batches(problems: Sequence[Problem]) -> Iterator[tuple[list[int], NormsOfBatch]]:
    """Yield the norms of batches of runs by `taylor`, with the indices of their problems.

    All other problems must be computed alone.
    """
    alike: dict[Hashable, list[int]] = {}
    for place, problem in enumerate(problems):
        if problem.solver["name"] == "taylor" and problem.sites <= MOST_SITES:
            cut = problem.equations.find_reduction()
            alike.setdefault((cut, *_what_runs_share(problem)), []).append(place)
    for (cut, *_), places in alike.items():
        equations = problems[places[0]].equations
        if equations.prepare_batch([equations], cut) is None:
            continue
        able = [place for place in places if not find_obstacle(problems[place].equations)]
        for first in range(0, len(able), LANES):
            members = able[first : first + LANES]
            if len(members) >= FEWEST_RUNS:
                ended, norms = _run_batch([problems[place] for place in members], cut)
                yield [members[number] for number in ended], norms


def _what_runs_share(problem: Problem) -> tuple[Hashable, ...]:
    """Return the properties that all runs of a batch have in common, besides their reduction."""
    chain = problem.model, problem.half_width, problem.site_count, problem.boundary
    times = problem.start_time, problem.end_time, problem.output_step
    numbers = frozenset((key, np.isscalar(value)) for key, value in problem.parameters.items())
    return *chain, *times, numbers, frozenset(problem.solver.items())


def _run_batch(problems: Sequence[Problem], cut: Reduction) -> tuple[np.ndarray, NormsOfBatch]:
    """Return the numbers of the runs that reached their end in a batch, and their norms."""
    batch, solver = [problem.equations for problem in problems], problems[0].solver
    inputs, times = batch[0].prepare_batch(batch, cut), batch[0].times
    states = np.array([equations.start(cut) for equations in batch])
    runs = make_batch(states, np.array(inputs.constants))
    record = blank_record(states.shape[1] // 2, states.shape[2] - 2, LANES * len(times), 0)
    controls = tuple(float(solver[key]) for key in METHODS["taylor"].controls)
    memory = aligned((memory_of(inputs.work, states),))
    interruptible(inputs.run, inputs.system, runs, times, controls, memory, record)
    linf, l2 = (norms.reshape(-1, LANES, len(times)) for norms in (record.linf, record.l2))
    is_finite = np.isfinite(linf).all(axis=(0, 2)) & np.isfinite(l2).all(axis=(0, 2))
    ended = np.flatnonzero(((runs.status == DONE) & is_finite)[: len(problems)])
    whole = Reduction(even=False, synchronised=cut.synchronised)
    rows = (unfold(norms[:, ended], whole).reshape(-1, len(times)) for norms in (linf, l2))
    return ended, NormsOfBatch([problems[n] for n in ended], problems[0].times, *rows)


# --- The results that are kept of each run --------------------------------------------------------


def _make_of(survey: Survey) -> Make:
    """Return the function that makes a run of a survey, in batches if this saves time.

    Functions of the user need whole trajectories, which batches do not compute.
    """
    if any(map(callable, survey.keep)) or prod(survey.shape) < MANY:
        return partial(_measure_run, survey=survey)
    return MakeTogether(partial(_measure_runs, survey=survey), count=16 * LANES)


def _measure_runs(problems: Sequence[Problem], survey: Survey) -> list[dict[str, Any]]:
    """Return the kept results of runs by name, from batches as far as possible."""
    results: dict[int, dict[str, Any]] = {}
    for places, norms in norms_in_batches(problems):
        results.update(zip(places, _measure_batch(norms, survey), strict=True))
    for place in range(len(problems)):
        if place not in results:
            results[place] = _measure_run(problems[place], survey)
    return [results[place] for place in range(len(problems))]


def _measure_batch(norms: NormsOfBatch, survey: Survey) -> list[dict[str, Any]]:
    """Return the kept results of the runs of a batch by name."""
    count = len(norms.problems)
    runs = [norms.of_run(number) for number in range(count)] if {*OF_RUNS} & {*survey.keep} else []
    columns: dict[str, Any] = {TEXT: [""] * count}
    for quantity in survey.keep:
        if quantity == "divergence":
            columns[quantity] = map(_divergence, norms.problems, runs)
        elif quantity == "exponent":
            columns[quantity] = [_exponent(run, survey.window) for run in runs]
        else:
            rows = _statistic(norms, survey.window, *quantity.split("_"))
            columns[quantity] = rows.reshape(-1, count).T
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _measure_run(problem: Problem, survey: Survey) -> dict[str, Any]:
    """Return the kept results of one run by name; NaN if it failed."""
    fields = len(problem.initial)
    try:
        functions = any(map(callable, survey.keep))  # they may read conserved quantities
        run, text = simulate(problem, conserved=functions), ""
        if remark := remark_on(run.solver):
            text = f"remark: {remark}"
    except IntegrationError as error:
        run, text = None, f"failure: {error}"
    quantities = {TEXT: text}
    for quantity in survey.keep:
        if callable(quantity):
            quantities[quantity.__name__] = np.nan if run is None else quantity(problem, run)
        elif run is None:
            quantities[quantity] = np.nan if quantity in OF_RUNS else np.full(fields, np.nan)
        elif quantity == "divergence":
            quantities[quantity] = _divergence(problem, run)
        elif quantity == "exponent":
            quantities[quantity] = _exponent(run, survey.window)
        else:
            quantities[quantity] = _statistic(run, survey.window, *quantity.split("_"))
    return quantities


def _statistic(
    run: Trajectory | NormsOfBatch, window: tuple[float, float] | None, statistic: str, norm: str
) -> np.ndarray:
    """Return the maximum, mean or final value of a norm of each field, (field,)."""
    series = getattr(run, norm)
    if statistic == "final":
        return series[:, -1]
    inside = series if window is None else series[:, within(run.tau, window)]
    return inside.max(axis=1) if statistic == "max" else mean_of(inside)


def _exponent(run: Trajectory, window: tuple[float, float] | None) -> float:
    """Return the exponent q of the fit of a power law tau^q to the total power in the window."""
    start, end = window or (run.tau[1], run.tau[-1])
    inside = within(run.tau, (start, end)) & (run.tau > 0.0)
    power = np.add.reduce(run.l2 * run.l2)[inside]
    if not power.all():
        return np.nan
    return lay_line(log(run.tau[inside]), log(power)).slope


def _divergence(problem: Problem, run: Trajectory) -> float:
    """Return the first time at which a run by another method differs visibly; inf if never."""
    method = other_family(run.solver["name"], problem.equations.methods)
    solver = {"name": method, "rtol": 1e-13, "atol": 1e-13}
    try:
        second_run = simulate(problem.changed(solver=solver), conserved=False)
    except IntegrationError:
        return np.nan
    difference = norm_difference(run.linf, run.l2, second_run.linf, second_run.l2)
    return float(first_above(run.tau, difference, VISIBLE))
