"""How the cost grows, with the chain and with time, and how near it is to the machine's limits."""

import tracemalloc
from time import perf_counter

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.simulation.lattice import Reduction

from . import limits
from .runs import follow
from .tasks import Task, set_task

SITES = (3, 5, 11, 31, 61, 201, 1001, 10_001, 100_001)
END_TIMES = (1.0, 10.0, 100.0, 1000.0)
SOLVERS = ("dop853", "taylor")
TOLERANCE = 1e-10
WORK = 40_000
"""Sites times units of tau of a run, so that short chains run long enough to be timed."""
REPEAT = 5
HALF = Reduction(even=True, synchronised=False)


def noisy_chain(sites: int, seed: int = 0) -> np.ndarray:
    """Return even amplitudes of order one on all sites: every site is in motion from the start."""
    rng = np.random.default_rng(seed)
    half = rng.normal(size=(2, sites // 2 + 1)) + 1j * rng.normal(size=(2, sites // 2 + 1))
    return np.concatenate([half[:, :0:-1], half], axis=1)


def _timed(run) -> tuple[float, object]:
    """Return the median time of a run, after one to warm up, and what it returned."""
    times, result = [], run()
    for _ in range(REPEAT):
        start = perf_counter()
        run()
        times.append(perf_counter() - start)
    return float(np.median(times)), result


def _peak_memory(run) -> int:
    tracemalloc.start()
    run()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


def _with_sites(sites: int, name: str) -> tuple[float, float, float]:
    """Return the time a site and unit of tau, the steps a unit of tau, and bytes a site."""
    end = min(50.0, max(1.0, WORK / sites))
    task = Task("noise", (1.0, 1.0, 0.0), "dirichlet", noisy_chain(sites), HALF, end, None)
    times = np.array([0.0, end])
    seconds, result = _timed(lambda: follow(task, times, name, TOLERANCE))
    memory = _peak_memory(lambda: follow(task, times, name, TOLERANCE))
    steps = result.outcome.steps + result.outcome.rejected
    return seconds / sites / end, steps / end, memory / sites


def measure(problem: dict) -> dict[str, Variable]:
    """Return the variables of the dataset; `problem` is the regular case that is run for long."""
    by_sites = np.array([[_with_sites(n, name) for name in SOLVERS] for n in SITES])
    by_time = np.array([[_until(problem, end, name) for name in SOLVERS] for end in END_TIMES])
    operations, moved = limits.count_dop853()
    flops, bytes_ = limits.arithmetic(), limits.bandwidth()
    grid, long = ("sites", "solver"), ("end_time", "solver")
    return {
        "sites": Variable(("sites",), np.array(SITES), "number of sites N"),
        "end_time": Variable(("end_time",), np.array(END_TIMES), "slow time at the end"),
        "solver": Variable(("solver",), np.array(SOLVERS), "solver"),
        "seconds": Variable(grid, by_sites[..., 0], "time a site and unit of slow time", "s"),
        "steps": Variable(grid, by_sites[..., 1], "steps a unit of slow time", "1"),
        "memory": Variable(grid, by_sites[..., 2], "largest memory a site", "byte"),
        "long_seconds": Variable(long, by_time, "time a site and unit of slow time", "s"),
        "arithmetic": Variable((), flops, "additions and multiplications a second", "s-1"),
        "bandwidth": Variable((), bytes_, "memory traffic of a triad", "byte s-1"),
        "operations": Variable((), operations, "operations of dop853 a site and step", "1"),
        "traffic": Variable((), moved, "array traffic of dop853 a site and step", "byte"),
    }


def _until(problem: dict, end: float, name: str) -> float:
    task = set_task("long", problem, end)
    seconds, _ = _timed(lambda: follow(task, np.array([0.0, end]), name, TOLERANCE))
    return seconds / task.amplitudes.shape[1] / end
