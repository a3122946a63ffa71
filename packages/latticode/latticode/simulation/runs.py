"""Many runs divided into chunks: one chunk, all chunks joined, and all runs on several cores.

Each run is reduced to its results as soon as it ends, to save memory. With n chunks, chunk k has
every n-th run from run k on, so all chunks take about equally long. The results have the same
bits for any number of chunks.
"""

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from typing import Any, NamedTuple

import numpy as np

from .interrupts import Interrupted, interruptible
from .problem import Problem
from .progress import show_progress

Make = Callable[[Problem], Mapping[str, Any]]
"""A function that runs a problem and returns the retained results by name."""
Retained = dict[int, Mapping[str, Any]]
"""Retained results by the number of the run."""


class MakeTogether(NamedTuple):
    """A `Make` that is faster for several problems.

    `make_all` yields the index of each problem with its results, in any order.
    """

    make_all: Callable[[Sequence[Problem]], Iterable[tuple[int, Mapping[str, Any]]]]
    count: int
    """Number of problems in a call."""

    def __call__(self, problem: Problem) -> Mapping[str, Any]:
        """Return the retained results of one problem by name."""
        [(_, results)] = self.make_all([problem])
        return results


Run = Callable[[Sequence[Problem], Make], dict[str, np.ndarray]]
"""A function such as `run_all`: it returns the retained results by name, each (run, ...)."""


def run_chunk(
    problems: Sequence[Problem],
    make: Make,
    chunk: int = 0,
    chunks: int = 1,
    progress: Callable[[int, int], None] = lambda done, count: None,
    retained: Retained | None = None,
) -> dict[str, np.ndarray]:
    """Return the results of every `chunks`-th run from number `chunk` on, each (run, ...).

    `progress` is called with the numbers of finished runs and of all runs in the chunk. Runs in
    `retained` are not repeated; the results of all other runs are added. Results of different
    shapes are padded with NaN.
    """
    numbers = range(chunk, len(problems), chunks)
    retained = {} if retained is None else retained
    absent = [number for number in numbers if number not in retained]
    together = make if isinstance(make, MakeTogether) else MakeTogether(_one_by_one(make), 1)

    def make_absent(stop: np.ndarray) -> None:
        done = len(numbers) - len(absent)
        for first in range(0, len(absent), together.count):
            chosen = absent[first : first + together.count]
            for index, results in together.make_all([problems[number] for number in chosen]):
                retained[chosen[index]] = results
                done += 1
                progress(done, len(numbers))

    interruptible(make_absent)  # one call for all runs, because each call takes time
    return table_of([retained[number] for number in numbers])


def _one_by_one(make: Make) -> Callable[[Sequence[Problem]], Iterator]:
    return lambda problems: enumerate(map(make, problems))


def table_of(runs: Sequence[Mapping[str, Any]]) -> dict[str, np.ndarray]:
    """Return the results of runs by name, each as one array (run, ...)."""
    names = dict.fromkeys(name for run in runs for name in run)
    return {name: stack([run[name] for run in runs if name in run]) for name in names}


def join_chunks(chunks: Iterable[Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Return the results of all chunks in the order of the runs, each (run, ...)."""
    chunks, tables = list(chunks), {}
    for name in chunks[0]:
        # a chunk without runs has no values
        values = [chunk[name] for chunk in chunks if name in chunk]
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
    """Return the results of all runs, each (run, ...), computed in one thread per core.

    Ctrl-C ends all threads; `retained` then has the results of the finished runs. Runs that it
    contains at the start are not repeated.
    """
    ended = threading.Event()

    def go_on(done: int, count: int) -> None:
        if ended.is_set():
            raise KeyboardInterrupt

    chunks = max(1, min(cores, len(problems)))
    with ThreadPoolExecutor(chunks) as pool:
        shared = chunks, go_on, retained
        try:  # includes `submit`, because the first chunk is running by then
            futures = [pool.submit(run_chunk, problems, make, n, *shared) for n in range(chunks)]
            over, _ = wait(futures, return_when=FIRST_EXCEPTION)
        finally:
            ended.set()
        for future in over:  # raise the error of the chunk that failed first
            future.result()
        return join_chunks([future.result() for future in futures])


class ManyRuns(NamedTuple):
    """A study of many runs: the problems, and functions for results of runs and of the study.

    `retain` runs a problem and returns its results by name. `conclude` takes the results of all
    runs, each (run, ...), and returns the result of the study. A workflow can thus divide the runs
    among any number of jobs.
    """

    problems: Sequence[Problem]
    retain: Make
    conclude: Callable[[dict[str, np.ndarray]], Any]

    def make(self, run: Run = run_all) -> Any:
        """Return the result of the study; `run` executes the runs."""
        return self.conclude(run(self.problems, self.retain))


def run_until_interrupted(
    problems: Sequence[Problem], make: Make, cores: int, retained: Retained
) -> dict[str, np.ndarray]:
    """Return the results of `run_all` and show its progress.

    After Ctrl-C, unfinished runs have NaN. Raises Interrupted if no run is finished.
    """
    try:
        with show_progress("survey", retained, len(problems)):
            return run_all(problems, make, cores, retained)
    except Interrupted:
        if not retained:
            raise
        done = dict(retained)  # a copy: a thread may still finish its run
        absent = {name: nothing_like(value) for name, value in done[min(done)].items()}
        return table_of([done.get(number, absent) for number in range(len(problems))])


UNFINISHED = "unfinished: the survey was interrupted before this run"
"""The text stored for an unfinished run."""


def nothing_like(value: Any) -> np.ndarray:
    """Return the placeholder, NaN or a text, for a result of an unfinished run."""
    values = np.asarray(value)
    if values.dtype.kind == "U":
        return np.array(UNFINISHED)
    return np.full(values.shape, np.nan if values.dtype.kind in "fc" else 0, values.dtype)


def reshape_runs(table: Mapping[str, np.ndarray], shape: Sequence[int]) -> dict[str, np.ndarray]:
    """Return results (run, ...) with the runs arranged in `shape`, each (*shape, ...)."""
    return {name: values.reshape(*shape, *values.shape[1:]) for name, values in table.items()}


def stack(values: Sequence[Any]) -> np.ndarray:
    """Return values of runs as one array (run, ...); smaller ones are padded with NaN."""
    arrays = [np.asarray(array) for array in values]
    return join_chunks([{"": array[None]} for array in arrays])[""]
