"""What a site costs, in time and in memory, on windows up to a million sites."""

import tracemalloc
from time import perf_counter

import numpy as np

from ..datasets import Variable
from .studies import TOLERANCE
from .window import advance

WIDTHS = (1_000, 10_000, 100_000, 500_000)
"""Half-widths W of windows of 2 W + 1 sites."""

DURATION = 0.5
CONSTANTS = (1.0, 1.0, 0.0)


def sea(width: int, seed: int = 2017) -> np.ndarray:
    """Return a window full of random amplitudes, as strong as those behind the front."""
    state = np.random.default_rng(seed).normal(scale=2.0, size=(4, width + 3))
    state[:, 0] = state[:, -1] = 0.0
    return state


def measure(widths=WIDTHS, duration: float = DURATION) -> dict[str, Variable]:
    """Return time a site and unit of tau, right-hand sides and peak memory of each width."""
    solver = {"name": "dop853", "rtol": TOLERANCE, "atol": TOLERANCE}
    times = np.array([0.0, duration])
    advance(CONSTANTS, sea(10), times, solver)  # compiled, or loaded
    seconds, evaluations, memory = [], [], []
    for width in widths:
        state = sea(width)
        tracemalloc.start()
        start = perf_counter()
        done = advance(CONSTANTS, state, times, solver)
        seconds.append((perf_counter() - start) / (width * duration))
        memory.append(tracemalloc.get_traced_memory()[1] + state.nbytes)
        tracemalloc.stop()
        evaluations.append(done.outcome.evaluations / duration)
    dims = ("width",)
    return {
        "width": Variable(dims, np.array(widths), "half-width W of the window of 2 W + 1 sites"),
        "seconds": Variable(dims, seconds, "time per site 0..W and unit of tau", "s"),
        "evaluations": Variable(dims, evaluations, "right-hand sides per unit of tau"),
        "memory": Variable(dims, memory, "largest memory of the run's arrays", "byte"),
    }


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
