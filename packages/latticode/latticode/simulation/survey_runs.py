"""Execution of a survey, and the results that are kept of each run."""

from collections.abc import Callable, Hashable, Iterator, Sequence
from functools import cache, partial
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

from .equations import CompiledMethod, Equations
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
MOST_OUTPUTS = 100_000
"""Largest number of outputs of a run in a batch: all runs of a batch are in memory at once."""
FEWEST_RUNS = LANES // 2
"""Smallest number of runs in a batch, whose steps take as long as those of LANES runs."""


class NormsOfBatch(NamedTuple):
    """The norms of runs with the same output times."""

    problems: list[Problem]
    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (run, component, time)
    l2: np.ndarray  # (run, component, time)

    def of_run(self, number: int) -> Trajectory:
        """Return the norms of one run, as a trajectory without fields."""
        linf, l2, nothing = self.linf[number], self.l2[number], np.empty(0)
        solver = dict(self.problems[number].solver)
        outcome = Outcome(DONE, self.tau[-1], 0, 0, 0)
        return Trajectory(self.tau, linf, l2, nothing, nothing, outcome, solver)


def norms_in_batches(problems: Sequence[Problem]) -> Iterator[tuple[list[int], NormsOfBatch]]:
    """Yield the norms of batches of runs by `taylor`, with the indices of their problems.

    All other problems must be computed alone.
    """
    groups: dict[Hashable, list[int]] = {}
    for place, problem in enumerate(problems):
        is_short = (
            problem.sites <= MOST_SITES and problem.span <= MOST_OUTPUTS * problem.output_step
        )
        if is_short and problem.solver["name"] == "taylor":
            cut = problem.equations.find_reduction()
            groups.setdefault((cut, *_what_runs_share(problem)), []).append(place)
    for (cut, *_), places in groups.items():
        able = [place for place in places if _can_run(problems[place].equations)]
        equations = [problems[place].equations for place in able]
        if not able or equations[0].prepare_batch(equations[:1], cut) is None:
            continue
        for first in range(0, len(able), LANES):
            members = able[first : first + LANES]
            if len(members) >= FEWEST_RUNS:
                ended, norms = _run_batch([problems[place] for place in members], cut)
                if ended.size:
                    yield [members[number] for number in ended], norms


def _what_runs_share(problem: Problem) -> tuple[Hashable, ...]:
    """Return the properties that all runs of a batch have in common, besides their reduction."""
    chain = problem.model, problem.half_width, problem.site_count, problem.boundary
    times = problem.start_time, problem.end_time, problem.output_step
    numbers = {key for key, value in problem.parameters.items() if np.isscalar(value)}
    # `site_dependent` takes as long as all the rest, and depends on the names alone if all values
    # are numbers
    by_site = problem.site_dependent if len(numbers) < len(problem.parameters) else None
    return *chain, *times, frozenset(numbers), by_site, frozenset(problem.solver.items())


def _can_run(equations: Equations) -> bool:
    """Return whether `taylor` can integrate the equations, and nothing prevents the run."""
    return "taylor" in equations.methods and not find_obstacle(equations)


def _run_batch(problems: Sequence[Problem], cut: Reduction) -> tuple[np.ndarray, NormsOfBatch]:
    """Return the numbers of the runs that reached their end in a batch, and their norms."""
    batch = [problem.equations for problem in problems]
    inputs, times = batch[0].prepare_batch(batch, cut), batch[0].times
    states = np.array([equations.start(cut) for equations in batch])
    runs = make_batch(states, np.array(inputs.constants))
    record = blank_record(states.shape[1] // 2, states.shape[2] - 2, LANES * len(times), 0)
    method = CompiledMethod(METHODS["taylor"], inputs.run)
    controls = method.controls_of(problems[0].solver, batch[0].atol_scale)
    memory = aligned((memory_of(inputs.work, states),))
    interruptible(inputs.run, inputs.system, runs, times, controls, memory, record)
    whole = Reduction(even=False, synchronised=cut.synchronised)
    # each run is contiguous, as a run alone: NumPy sums arrays of another layout in another order
    linf, l2 = (
        np.ascontiguousarray(unfold(norms.reshape(-1, LANES, len(times)), whole).swapaxes(0, 1))
        for norms in (record.linf, record.l2)
    )
    is_finite = np.isfinite(linf).all(axis=(1, 2)) & np.isfinite(l2).all(axis=(1, 2))
    ended = np.flatnonzero(((runs.status == DONE) & is_finite)[: len(problems)])
    ended_problems = [problems[number] for number in ended]
    return ended, NormsOfBatch(ended_problems, problems[0].times, linf[ended], l2[ended])


# --- The results that are kept of each run --------------------------------------------------------


def _make_of(survey: Survey) -> Make:
    """Return the function that makes a run of a survey, in batches if the survey is large.

    Functions of the user need whole trajectories, which batches do not compute.
    """
    if any(map(callable, survey.keep)) or prod(survey.shape) < MANY:
        return partial(_measure_run, survey=survey)
    return MakeTogether(partial(_measure_runs, survey=survey), count=16 * LANES)


def _measure_runs(
    problems: Sequence[Problem], survey: Survey
) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the index of each problem and the kept results of its run, in batches if possible."""
    alone = dict.fromkeys(range(len(problems)))
    for places, norms in norms_in_batches(problems):
        for number, place in enumerate(places):
            del alone[place]
            yield place, _quantities(problems[place], norms.of_run(number), survey)
    for place in alone:
        yield place, _measure_run(problems[place], survey)


def _measure_run(problem: Problem, survey: Survey) -> dict[str, Any]:
    """Return the kept results of one run by name; NaN if it failed."""
    functions = any(map(callable, survey.keep))  # they may read conserved quantities
    try:
        run = simulate(problem, conserved=functions)
    except IntegrationError as error:
        return _quantities(problem, None, survey, f"failure: {error}")
    remark = remark_on(run.solver)
    return _quantities(problem, run, survey, f"remark: {remark}" if remark else "")


def _quantities(
    problem: Problem, run: Trajectory | None, survey: Survey, text: str = ""
) -> dict[str, Any]:
    """Return the kept results of one run by name; NaN if `run` is None."""
    fields = len(problem.initial)

    @cache
    def inside(norm: str) -> np.ndarray:
        """Return a norm in the window, (field, time)."""
        series = getattr(run, norm)
        return series if survey.window is None else series[:, within(run.tau, survey.window)]

    quantities: dict[str, Any] = {TEXT: text}
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
            quantities[quantity] = _statistic(run, inside, *quantity.split("_"))
    return quantities


def _statistic(
    run: Trajectory, inside: Callable[[str], np.ndarray], statistic: str, norm: str
) -> np.ndarray:
    """Return the maximum, mean or final value of a norm of each field, (field,)."""
    if statistic == "final":
        return getattr(run, norm)[:, -1]
    return inside(norm).max(axis=1) if statistic == "max" else mean_of(inside(norm))


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
