"""Long runs on an infinite chain, reduced to the norms and the sites of both fronts.

The library integrates the active sites; a state consists of S and D (see `sums`).
"""

from collections.abc import Sequence

import numpy as np
from latticode.simulation.active_sites import integrate_intervals
from latticode.simulation.observables import ObservableRecord

from pendula.problem import PaperProblem

from .bulk import EDGE, LEVEL, SLICE_LENGTH, find_front, region_means, site_powers
from .sums import halves, in_sums, turned


def run_long(
    problem: PaperProblem,
    rest_threshold: float,
    levels: Sequence[float] = (LEVEL,),
    edges: Sequence[int] = (EDGE,),
) -> dict[str, np.ndarray]:
    """Return the series of a run of `problem` on an infinite chain.

    The series at the times `tau` are `l2` and `linf` of the pair (A, B). Those at the times
    `piece_tau` are `front`, `second_front` and `means`. `front` is the site of the first front, and
    `second_front` that of the second for all `levels`, -1 if there is none. `means` are those of
    `region_means` for all `edges`, with the second front at the first level. A single level or edge
    has no axis. If the data are not even in n, only the norms include the sites with n < 0.
    """
    outputs, states = [], []
    for times, record, _, sites in integrate_intervals(
        in_sums(problem), rest_threshold, SLICE_LENGTH
    ):
        first = 1 if outputs else 0  # the first output repeats the last one of the interval before
        outputs.append(np.array([times, *_norms(record)])[:, first:])
        power = site_powers(sites[:2])
        front, second = (
            find_front(site_powers(sites)),
            [find_front(power, level) for level in levels],
        )
        means = [region_means(sites, front, second[0], edge) for edge in edges]
        states.append((times[-1], front, _one_or_all(second), _one_or_all(means)))
    series = dict(zip(("tau", "l2", "linf"), np.concatenate(outputs, axis=1), strict=True))
    names = ("piece_tau", "front", "second_front", "means")
    return series | dict(zip(names, map(np.array, zip(*states, strict=True)), strict=True))


def _one_or_all(values: list) -> np.ndarray:
    """Return the only value, or an array of all if there are several."""
    return np.array(values if len(values) > 1 else values[0])


def _norms(record: ObservableRecord) -> tuple[np.ndarray, np.ndarray]:
    """Return l2 and l-infinity of the pair (A, B) at every output, each (time,)."""
    s, d = np.swapaxes(record.snapshots, 0, 1)  # (Re or Im, site, time)
    squares = np.maximum(*(site_powers(re_im) for re_im in halves(turned(np.concatenate([s, d])))))
    return np.sqrt((record.l2**2).sum(axis=0)), np.sqrt(squares.max(axis=0))
