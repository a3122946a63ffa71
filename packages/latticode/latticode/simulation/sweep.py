"""Runs of a case for many half-widths; maxima and means of the norms over time windows."""

from collections.abc import Sequence

import numpy as np

from latticode.integrators.families import remark_on
from latticode.numerics.elementary import square_modulus
from latticode.simulation.problem import Problem

from .runs import ManyRuns, Run, run_all
from .simulate import Trajectory, simulate

QUANTITIES = ("A", "B", "pair")
STATISTICS = ("max", "mean")
REACHED = 1e-20
"""The ends matter if the power at an end site exceeds this fraction of the largest power of a site.
Otherwise their effect on norms is far below rounding."""

Window = tuple[float, float]


def sweep(
    problem: Problem, half_widths: Sequence[int], windows: Sequence[Window], run: Run = run_all
) -> dict[str, np.ndarray]:
    """Return the statistics of `windowed` by name, each (half-width, ...)."""
    return runs_of_sweep(problem, half_widths, windows).make(run)


def runs_of_sweep(
    problem: Problem, half_widths: Sequence[int], windows: Sequence[Window]
) -> ManyRuns:
    """Return the runs of a sweep; their conclusion is the result of `sweep`.

    If a run ends before the motion reaches the ends of the chain, longer chains give the same
    statistics and are not run, unless parameters depend on the site.
    """
    problem = problem.changed(snapshot_every=0, snapshots_at=())
    uniform = not (problem.site_dependent or problem.model.matrices)
    enough, inside, printed = np.inf, None, False

    def make(chain: Problem) -> dict[str, np.ndarray]:
        nonlocal enough, inside, printed
        if chain.half_width >= enough:
            return inside
        trajectory = simulate(chain, conserved=False)
        if (remark := remark_on(trajectory.solver)) and not printed:
            print(f"half-width {chain.half_width}: {remark}", flush=True)
            printed = True
        statistics = windowed(trajectory, windows)
        if uniform and _is_inside(trajectory):
            enough, inside = chain.half_width, statistics
        return statistics

    return ManyRuns([problem.changed(half_width=width) for width in half_widths], make, dict)


def windowed(trajectory: Trajectory, windows: Sequence[Window]) -> dict[str, np.ndarray]:
    """Return the statistics "l2" and "linf" (quantity, statistic, window), and the "work" (3,).

    The work consists of the numbers of steps, rejected steps and evaluations.
    """
    return {
        "l2": _over_windows(trajectory.tau, pair_l2(trajectory), windows),
        "linf": _over_windows(trajectory.tau, pair_linf(trajectory), windows),
        "work": np.array(trajectory.outcome[-3:]),
    }


def _is_inside(trajectory: Trajectory) -> bool:
    """Return whether both ends of the chain are still at rest at the end of the run."""
    power = square_modulus(trajectory.final)
    return bool(power[..., [0, -1]].max() <= REACHED * power.max())


def pair_l2(trajectory: Trajectory) -> np.ndarray:
    """Return the l2 norms of A, of B, and of the pair (A, B), (quantity, time)."""
    return np.array([*trajectory.l2, np.sqrt(np.add.reduce(trajectory.l2 * trajectory.l2))])


def pair_linf(trajectory: Trajectory) -> np.ndarray:
    """Return the l-infinity norms of A, of B, and of the pair (A, B), (quantity, time)."""
    return np.array([*trajectory.linf, np.maximum.reduce(trajectory.linf)])


def _over_windows(tau: np.ndarray, series: np.ndarray, windows: Sequence[Window]) -> np.ndarray:
    """Return maxima and means of `series` over windows, (quantity, statistic, window)."""
    inside = [series[:, within(tau, window)] for window in windows]
    statistics = [[norms.max(axis=1) for norms in inside], [mean_of(norms) for norms in inside]]
    return np.array(statistics).transpose(2, 0, 1)


def within(tau: np.ndarray, window: Window) -> np.ndarray:
    """Return whether each time lies in a window, both ends included, (time,)."""
    start, end = window
    return (tau >= start - 1e-9) & (tau <= end + 1e-9)


def mean_of(series: np.ndarray) -> np.ndarray:
    """Return the means (quantity,) over time by the trapezoidal rule on equal steps."""
    ends = 0.5 * (series[:, 0] + series[:, -1])
    return (series[:, 1:-1].sum(axis=1) + ends) / (series.shape[1] - 1)
