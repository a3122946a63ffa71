"""How the cost of a run grows with the chain, with time, and with the sites in motion.

Costs are times a site and unit of slow time. An infinite chain has no number of sites; its cost
is counted by its active sites, those that are integrated: 0..W of data that are even in n.
"""

from functools import partial
from itertools import product

import numpy as np
from pendula.datasets.netcdf import Variable
from pendula.problem import Constants, Problem
from pendula.simulation.simulate import simulate
from pendula.studies.unbounded.active_sites import advance

from . import machine
from .contestants import BLOCK, PAIRS, PEERS, controls, find_peers
from .problems import until
from .timing import clocked, in_turns, peak_memory, repeat

SITES = (3, 5, 11, 31, 61, 201, 1001, 10_001, 100_001)
END_TIMES = (1.0, 10.0, 100.0, 1000.0)
SOLVERS = ("dop853", "taylor")
TOLERANCE = 1e-10
WORK = 40_000
"""Sites times units of tau of a run, so that short chains run long enough to be timed."""
REPEAT = 5
BY_HAND = ("cpp_taylor", "cpp_taylor_contracted", "cpp_taylor_eight")
"""The method of `taylor` in C++. Short runs compare the calls from Python, long ones kernels."""

ACTIVE_WIDTHS = (1_000, 3_000, 10_000, 100_000, 500_000)
"""W where 2W + 1 sites of an infinite chain are active."""
ACTIVE_DURATION = 0.5
ACTIVE_TOLERANCE = 1e-8
"""What the study of the infinite chain asks for."""

CONSTANTS = Constants(epsilon=1.0, gamma=1.0, omega=0.0)


def measure(problem: Problem) -> dict[str, Variable]:
    """Return the variables of the dataset; `problem` is the regular case that is run for long."""
    by_sites = np.array([[measure_chain(n, name) for name in SOLVERS] for n in SITES])
    by_time = np.array([[_until(problem, end, name) for name in SOLVERS] for end in END_TIMES])
    grid, long = ("sites", "solver"), ("end_time", "solver")
    return {
        "sites": Variable(("sites",), np.array(SITES)),
        "end_time": Variable(("end_time",), np.array(END_TIMES), "slow time at the end"),
        "solver": Variable(("solver",), np.array(SOLVERS)),
        "seconds": Variable(grid, by_sites[..., 0], "time a site and unit of slow time", "s"),
        "steps": Variable(grid, by_sites[..., 1], "steps a unit of slow time", "1"),
        "memory": Variable(grid, by_sites[..., 2], "largest memory a site", "byte"),
        "long_seconds": Variable(long, by_time, "time a site and unit of slow time", "s"),
        **measure_by_hand(problem),
        **measure_active(),
        **machine.measure(),
    }


def noisy_chain(sites: int, name: str) -> Problem:
    """Return a chain with even amplitudes of order one: every site moves from the start."""
    rng = np.random.default_rng(0)
    half = rng.normal(size=(2, sites // 2 + 1)) + 1j * rng.normal(size=(2, sites // 2 + 1))
    end = min(50.0, max(1.0, WORK / sites))
    return Problem(
        constants=CONSTANTS,
        half_width=sites // 2,
        boundary="dirichlet",
        initial=np.concatenate([half[:, :0:-1], half], axis=1),
        end_time=end,
        output_step=end,
        solver=controls(name, TOLERANCE),
    )


def measure_chain(sites: int, name: str) -> tuple[float, float, float]:
    """Return the time a site and unit of tau, the steps a unit of tau, and bytes a site."""
    problem = noisy_chain(sites, name)
    end, work = problem.end_time, simulate(problem).outcome
    seconds = repeat(clocked(lambda: simulate(problem)), REPEAT).median
    memory = peak_memory(lambda: simulate(problem))
    return seconds / sites / end, (work.steps + work.rejected) / end, memory / sites


def _until(problem: Problem, end: float, name: str) -> float:
    given = until(problem, end, solver=controls(name, TOLERANCE))
    seconds = repeat(clocked(lambda: simulate(given)), REPEAT).median
    return seconds / given.sites / end


def measure_by_hand(problem: Problem) -> dict[str, Variable]:
    """Return how many times as long the method in C++ takes as `taylor`, at the same tolerance.

    Where a program of it cannot be compiled or run, the ratio is not a number.
    """
    present, _ = find_peers()
    ratios = np.full((len(END_TIMES), len(BY_HAND)), np.nan)
    for (i, end), (j, name) in product(enumerate(END_TIMES), enumerate(BY_HAND)):
        if name in present:
            given = until(problem, end, solver=controls("taylor", TOLERANCE))
            solve = partial(present[name].prepare(given), TOLERANCE)
            ours = clocked(partial(simulate, given))
            ratios[i, j] = np.median(in_turns(lambda s=solve: s()[1], ours, PAIRS, BLOCK))
    titles = np.array([PEERS[name].title for name in BY_HAND])
    said = "time of the method in C++ over that of taylor, median of pairs"
    return {
        "by_hand": Variable(("by_hand",), titles, "method in C++"),
        "by_hand_ratio": Variable(("end_time", "by_hand"), ratios, said, "1"),
    }


def active_sites(width: int) -> np.ndarray:
    """Return a state on the sites 0..W with amplitudes as strong as those behind the front.

    Only their phases are random: the largest of a million would shorten the steps.
    """
    phases = np.random.default_rng(2017).uniform(0.0, 2.0 * np.pi, size=(2, width + 1))
    state = np.zeros((4, width + 3))
    state[0::2, 1:-1], state[1::2, 1:-1] = 3.0 * np.cos(phases), 3.0 * np.sin(phases)
    return state


def measure_active() -> dict[str, Variable]:
    """Return time, right-hand sides and memory of DOP853 on an infinite chain."""
    rows = np.array([_of_active(width) for width in ACTIVE_WIDTHS])
    dims, seconds = ("active_width",), "time a site 0..W and unit of slow time"
    return {
        "active_width": Variable(dims, np.array(ACTIVE_WIDTHS), "W of 2 W + 1 active sites"),
        "active_seconds": Variable(dims, rows[:, 0], seconds, "s"),
        "active_evaluations": Variable(dims, rows[:, 1], "right-hand sides a unit of slow time"),
        "active_memory": Variable(dims, rows[:, 2], "largest memory a site 0..W", "byte"),
    }


def _of_active(width: int) -> tuple[float, float, float]:
    """Return the time and memory a site 0..W, the right-hand sides, each a unit of tau."""
    times = np.array([0.0, ACTIVE_DURATION])
    solver = controls("dop853", ACTIVE_TOLERANCE)

    def run():
        return advance(CONSTANTS, active_sites(width), times, solver)

    def run_for_seconds():
        state = active_sites(width)
        return clocked(lambda: advance(CONSTANTS, state, times, solver))()

    evaluations = run().outcome.evaluations
    seconds = repeat(run_for_seconds, REPEAT, warm=True).median
    memory = peak_memory(run)
    return seconds / width / ACTIVE_DURATION, evaluations / ACTIVE_DURATION, memory / width
