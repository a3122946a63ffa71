"""Many runs in parts: what is made, a part of it, and all parts joined.

What is kept of a run is reduced as soon as the run is over, so that the memory of many is that of
their results. A part is every so many-th run, so that parts take alike long, and results have the
same bits in any number of parts.
"""

import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from typing import Any, NamedTuple

import numpy as np

from .interrupts import Interrupted, interruptible
from .problem import Problem
from .progress import show_progress

Make = Callable[[Problem], Mapping[str, Any]]
"""What makes the run of a problem and returns what is kept of it, by name."""
Retained = dict[int, Mapping[str, Any]]
"""What is kept of runs, by the number of the run."""
Run = Callable[[Sequence[Problem], Make], dict[str, np.ndarray]]
"""What makes the runs of problems, such as `run_all`, and returns what is kept, each (run, ...)."""


def run_chunk(
    problems: Sequence[Problem],
    make: Make,
    chunk: int = 0,
    chunks: int = 1,
    progress: Callable[[int, int], None] = lambda done, count: None,
    retained: Retained | None = None,
) -> dict[str, np.ndarray]:
    """Return what is kept of every `chunks`-th run from number `chunk` on, each (run, ...).

    `progress` is called with the number of runs that are done, and of all in the part. Runs that
    are in `retained` are not made again, and what is kept of the others is added to it. Where what
    is kept has not the same shape of all runs, NaN fill it up.
    """
    numbers = range(chunk, len(problems), chunks)
    retained = {} if retained is None else retained

    def make_all(stop: np.ndarray) -> None:  # all in one thread: handing over takes time
        for done, number in enumerate(numbers, 1):
            if number not in retained:
                retained[number] = make(problems[number])
            progress(done, len(numbers))

    interruptible(make_all)
    return table_of([retained[number] for number in numbers])


def table_of(runs: Sequence[Mapping[str, Any]]) -> dict[str, np.ndarray]:
    """Return what is kept of runs by name, each (run, ...)."""
    names = dict.fromkeys(name for run in runs for name in run)
    return {name: stack([run[name] for run in runs if name in run]) for name in names}


def join_chunks(chunks: Iterable[Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Return what all parts hold in the order of the runs, each (run, ...)."""
    chunks, tables = list(chunks), {}
    for name in chunks[0]:
        values = [
            chunk[name] for chunk in chunks if name in chunk
        ]  # more parts than runs: no values
        rank, kind = max(array.ndim for array in values), np.result_type(*values)
        values = [array.reshape(array.shape + (1,) * (rank - array.ndim)) for array in values]
        shape = np.max([array.shape[1:] for array in values], axis=0).astype(int)
        nothing = np.nan if kind.kind in "fc" else 0
        table = np.full((sum(map(len, values)), *shape), nothing, kind)
        for number, array in enumerate(values):
            table[(slice(number, None, len(chunks)), *map(slice, array.shape[1:]))] = array
        tables[name] = table
    return tables


def run_all(
    problems: Sequence[Problem], make: Make, cores: int = 1, retained: Retained | None = None
) -> dict[str, np.ndarray]:
    """Return what is kept of all runs, each (run, ...), made in a part for each core.

    Kernels run beside each other in threads. Ctrl-C ends all of them; `retained` then has the runs
    that are done, and those that it has at the start are not made again.
    """
    ended = threading.Event()

    def go_on(done: int, count: int) -> None:
        if ended.is_set():
            raise KeyboardInterrupt

    chunks = max(1, min(cores, len(problems)))
    with ThreadPoolExecutor(chunks) as pool:
        shared = chunks, go_on, retained
        try:  # from the first part on, which runs while others are handed over
            futures = [pool.submit(run_chunk, problems, make, n, *shared) for n in range(chunks)]
            over, _ = wait(futures, return_when=FIRST_EXCEPTION)
        finally:
            ended.set()
        for future in over:  # raise the error of the part that failed, not that of parts it ended
            future.result()
        return join_chunks([future.result() for future in futures])


class ManyRuns(NamedTuple):
    """A study of many runs: their problems, what is retained of each, and what all of them give.

    `retain` makes the run of a problem and returns what is retained of it, by name. `conclude`
    takes this of all runs, each (run, ...), and returns the result of the study. A workflow can
    thus make the runs in any number of jobs.
    """

    problems: Sequence[Problem]
    retain: Make
    conclude: Callable[[dict[str, np.ndarray]], Any]

    def make(self, run: Run = run_all) -> Any:
        """Return the result of the study, its runs made by `run`."""
        return self.conclude(run(self.problems, self.retain))


def run_until_interrupted(
    problems: Sequence[Problem], make: Make, cores: int, retained: Retained
) -> dict[str, np.ndarray]:
    """Return what `run_all` returns; after Ctrl-C what is kept of the runs that are done.

    The others then have NaN. Shows progress. Raises Interrupted where no run is done.
    """
    try:
        with show_progress("survey", retained, len(problems)):
            return run_all(problems, make, cores, retained)
    except Interrupted:
        if not retained:
            raise
        done = dict(retained)  # a thread may still end its run
        absent = {name: nothing_like(value) for name, value in done[min(done)].items()}
        return table_of([done.get(number, absent) for number in range(len(problems))])


UNFINISHED = "unfinished: the survey was interrupted before this run"
"""The text of a run that was not made."""


def nothing_like(value: Any) -> np.ndarray:
    """Return what stands in place of a value of a run that was not made: NaN, or a text."""
    values = np.asarray(value)
    if values.dtype.kind == "U":
        return np.array(UNFINISHED)
    return np.full(values.shape, np.nan if values.dtype.kind in "fc" else 0, values.dtype)


def reshape_runs(table: Mapping[str, np.ndarray], shape: Sequence[int]) -> dict[str, np.ndarray]:
    """Return what is kept of runs (run, ...) with as many dimensions in place of the first."""
    return {name: values.reshape(*shape, *values.shape[1:]) for name, values in table.items()}


def stack(values: Sequence[Any]) -> np.ndarray:
    """Return values of runs as one array (run, ...), with NaN behind those of smaller shapes."""
    arrays = [np.asarray(array) for array in values]
    return join_chunks([{"": array[None]} for array in arrays])[""]
