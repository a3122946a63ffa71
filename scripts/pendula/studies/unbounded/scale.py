"""What a site costs, in time and in memory, on windows up to a million sites."""

import tracemalloc
from operator import itemgetter
from time import perf_counter

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.problem import Constants

from .studies import TOLERANCE
from .window import Piece, advance

WIDTHS = (1_000, 3_000, 10_000, 100_000, 500_000)
"""Half-widths W of windows of 2 W + 1 sites."""

DURATION, RUNS = 0.5, 3
CONSTANTS = Constants(epsilon=1.0, gamma=1.0, omega=0.0)


def sea(width: int, seed: int = 2017) -> np.ndarray:
    """Return a window full of amplitudes of the strength of those behind the front.

    Only their phases are random: the largest of a million would shorten the steps.
    """
    phases = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, size=(2, width + 1))
    state = np.zeros((4, width + 3))
    state[0::2, 1:-1], state[1::2, 1:-1] = 3.0 * np.cos(phases), 3.0 * np.sin(phases)
    return state


def measure(widths=WIDTHS, duration: float = DURATION) -> dict[str, Variable]:
    """Return time a site and unit of tau (the best of RUNS), right-hand sides and peak memory."""
    solver = {"name": "dop853", "rtol": TOLERANCE, "atol": TOLERANCE}
    times = np.array([0.0, duration])
    advance(CONSTANTS, sea(10), times, solver)  # compiled, or loaded
    seconds, evaluations, memory = [], [], []
    for width in widths:
        took, done, peak = min((_run(width, times, solver) for _ in range(RUNS)), key=itemgetter(0))
        seconds.append(took / (width * duration))
        evaluations.append(done.outcome.evaluations / duration)
        memory.append(peak)
    dims = ("width",)
    return {
        "width": Variable(dims, np.array(widths), "half-width W of the window of 2 W + 1 sites"),
        "seconds": Variable(dims, seconds, "time per site 0..W and unit of tau", "s"),
        "evaluations": Variable(dims, evaluations, "right-hand sides per unit of tau"),
        "memory": Variable(dims, memory, "largest memory of the run's arrays", "byte"),
    }


def _run(width: int, times: np.ndarray, solver: dict) -> tuple[float, Piece, int]:
    """Return the time and the peak memory of one run on a window."""
    state = sea(width)
    tracemalloc.start()
    start = perf_counter()
    done = advance(CONSTANTS, state, times, solver)
    took = perf_counter() - start
    peak = tracemalloc.get_traced_memory()[1] + state.nbytes
    tracemalloc.stop()
    return took, done, peak


def tabulate(measured: dict[str, Variable]) -> str:
    """Return the measurements as a table in Markdown."""
    lines = [
        "| sites 2W + 1 | us per site 0..W and unit of tau | right-hand sides per unit of tau | "
        "ns per site and right-hand side | bytes per site 0..W |",
        "|---|---|---|---|---|",
    ]
    columns = (measured[name].values for name in ("width", "seconds", "evaluations", "memory"))
    for width, seconds, evaluations, memory in zip(*columns, strict=True):
        each = 1e9 * seconds / evaluations
        numbers = f"{1e6 * seconds:.1f} | {evaluations:.0f} | {each:.1f} | {memory / width:.0f}"
        lines.append(f"| {2 * width + 1:,} | {numbers} |")
    return "\n".join(lines)
