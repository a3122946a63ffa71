"""Maxima of the norms over [10, T] on chains of half-width M, for many M and T at once.

One run of a chain gives the maxima for all T up to its end. A chain whose front never reached
its end is a chain without ends: all longer ones have the same numbers.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.problem import Problem

from .active_sites import LongRun, run_long

START = 10.0
"""Where the paper's windows begin."""


class WindowMap(NamedTuple):
    """Maxima of the pair's norms over [START, end], (half_width, end)."""

    l2: np.ndarray
    linf: np.ndarray
    arrival: np.ndarray  # (half_width,): when the sites in motion reached its end, NaN if never


def window_map(
    problem: Problem,
    rest: float,
    half_widths: list[int],
    ends: np.ndarray,
    progress: Callable[[str], None] = lambda message: None,
) -> WindowMap:
    """Return the maxima for each of the rising `half_widths` (see `run_long` for `rest`)."""
    l2, linf, arrival = [], [], []
    free = False
    for half_width in half_widths:
        if not free:
            run = run_long(problem.changed(half_width=half_width), rest)
            free = run.width[-1] < half_width
            progress(f"half-width {half_width}: {'no end reached' if free else 'done'}")
        l2.append(maxima(run.tau, run.l2, ends))
        linf.append(maxima(run.tau, run.linf, ends))
        arrival.append(np.nan if free else arrival_time(run, half_width))
    return WindowMap(np.array(l2), np.array(linf), np.array(arrival))


def maxima(tau: np.ndarray, series: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return the largest value over [START, end] for each of `ends`."""
    first = np.searchsorted(tau, START - 1e-9)
    running = np.maximum.accumulate(series[first:])
    return running[np.searchsorted(tau[first:], np.asarray(ends) + 1e-9) - 1]


def arrival_time(run: LongRun, half_width: int) -> float:
    """Return when the sites in motion first covered the whole chain."""
    return float(run.piece_tau[np.argmax(run.width == half_width)])


def map_variables(
    maps: list[WindowMap], half_widths: list[int], ends: np.ndarray, speed: float
) -> dict[str, Variable]:
    """Return the variables of the maps of an ensemble's members."""
    axes = ("member", "half_width", "end")
    window = f"maximum over [{START:g}, end]"
    return {
        "half_width": Variable(
            ("half_width",), np.asarray(half_widths), "half-width M of the chain of 2M + 1 pairs"
        ),
        "end": Variable(("end",), ends, "end of the window of slow time"),
        "l2": Variable(axes, [m.l2 for m in maps], f"l2 norm of (A, B), {window}"),
        "linf": Variable(axes, [m.linf for m in maps], f"l-infinity norm of (A, B), {window}"),
        "arrival": Variable(
            axes[:2],
            [m.arrival for m in maps],
            "slow time at which the motion reached the end",
        ),
        "predicted_speed": Variable((), speed, "linear spreading speed (sites per tau)"),
    }
