"""What a batch of short chains saves: a run in it against the same run alone, in turns."""

from time import perf_counter

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.simulation.batches import integrate_batch
from pendula.simulation.lattice import WHOLE

from .runs import follow
from .tasks import Task

SITES = (1, 3, 5, 9, 21, 61)
BATCHES = (8, 64)
TURNS = 15
END = 20.0
TOLERANCE = 1e-10
CONSTANTS = (1.0, 1.0, 0.0)


def noisy_chains(runs: int, sites: int, seed: int = 0) -> np.ndarray:
    """Return amplitudes (run, 2, N) of order one on all sites."""
    rng = np.random.default_rng([seed, sites])
    return rng.normal(size=(runs, 2, sites)) + 1j * rng.normal(size=(runs, 2, sites))


def _seconds(run) -> float:
    start = perf_counter()
    run()
    return perf_counter() - start


def _compare(sites: int, runs: int) -> tuple[float, np.ndarray]:
    """Return the time of a run alone, and in each turn how many times cheaper it is in a batch."""
    data, times = noisy_chains(runs, sites), np.array([0.0, END])
    tasks = [Task("noise", CONSTANTS, "dirichlet", z, WHOLE, END, None) for z in data]
    constants = np.tile(CONSTANTS, (runs, 1))

    def one_by_one():
        for task in tasks:
            follow(task, times, "taylor", TOLERANCE)

    def together():
        integrate_batch(constants, "dirichlet", data, times, TOLERANCE, TOLERANCE)

    one_by_one(), together()  # what is not compiled yet is compiled before the first turn
    turns = np.array([(_seconds(one_by_one), _seconds(together)) for _ in range(TURNS)])
    return np.median(turns[:, 0]) / runs, turns[:, 0] / turns[:, 1]


def measure() -> dict[str, Variable]:
    """Return variables over the length of the chain and the number of runs in the batch."""
    found = [[_compare(sites, runs) for runs in BATCHES] for sites in SITES]
    alone = np.array([[seconds for seconds, _ in row] for row in found])
    ratios = np.array([[turns for _, turns in row] for row in found])
    grid = ("short_sites", "batch")
    return {
        "short_sites": Variable(("short_sites",), np.array(SITES), "number of sites N"),
        "batch": Variable(("batch",), np.array(BATCHES), "runs in a batch"),
        "alone_seconds": Variable(grid, alone, "time of a run alone", "s"),
        "gain": Variable(grid, np.median(ratios, axis=2), "time alone over time in a batch", "1"),
        "gain_least": Variable(grid, ratios.min(axis=2), "the least of the turns", "1"),
        "gain_most": Variable(grid, ratios.max(axis=2), "the largest of the turns", "1"),
    }
