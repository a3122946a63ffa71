"""What two runs of one chaotic motion share: statistics of curves, and how far runs are apart.

After the horizon of trust two right runs take different paths, so points cannot be compared. The
path as a whole keeps its nature: its level and trend, how far and how roughly it moves within one
sample and within many, and that it goes on from the part that all runs share without a jump. Each
statistic below is chosen because some fault changes it and leaves the others alone.
"""

import numpy as np

STATISTICS = {
    "level": "mean",
    "width": "log of the standard deviation",
    "top": "largest value",
    "bottom": "smallest value",
    "slope": "change along the straight line that fits best",
    "roughness": "log of the root mean square of the increments from sample to sample",
    "bend": "log of the root mean square of the second differences",
    "jump": "log of the largest second difference, the step into the tail included",
    "wander": "log of the root mean square of the increments over a sixteenth of the tail",
    "lean": "skewness of the increments, which changes its sign where time is reversed",
    "gaps": "number of NaN",
    "infinities": "number of infinities",
    "negative infinities": "number of negative infinities",
}
"""What is compared of the tail of a curve, in units of its scale where it is no logarithm."""

COUNTS = ("gaps", "infinities", "negative infinities")
"""The statistics that count samples."""

DISTANCES = {
    "farthest": "log of the largest difference between two runs",
    "apart": "log of the root mean square of the difference between two runs",
}
"""What is compared of two runs together: two right ones stay this near to each other."""

LEAST = 4
"""So many samples or more have a trend and increments."""

TINY = 1e-300


def describe(values: np.ndarray, start: int = 0) -> np.ndarray:
    """Return the statistics (in the order of STATISTICS) of a curve from the sample `start` on.

    `values` has the shape (row, sample): rows are alike (sites, quantiles, ...), and the statistics
    are those of all rows together. What too few samples cannot tell is NaN.
    """
    found = dict.fromkeys(STATISTICS, np.nan)
    finite = np.isfinite(values)
    found |= dict.fromkeys(COUNTS, 0.0)
    if not finite.all():
        counts = np.isnan(values), values == np.inf, values == -np.inf
        found |= {name: float(of.sum()) for name, of in zip(COUNTS, counts, strict=True)}
        values, start = values[finite][None], 0
    tail = values[:, start:]
    if tail.size:
        found["level"] = tail.mean()
    if tail.shape[1] >= LEAST:
        found |= _motion(values, tail, start)
    return np.array(list(found.values()))


def _motion(values: np.ndarray, tail: np.ndarray, start: int) -> dict[str, float]:
    """Return the statistics that need several samples."""
    samples = tail.shape[1]
    along = np.linspace(-0.5, 0.5, samples)
    centred = tail - tail.mean(1, keepdims=True)
    steps = np.diff(tail)
    square = (steps**2).mean()
    lag = max(2, samples // 16)
    return {
        "top": tail.max(),
        "bottom": tail.min(),
        "width": _log(np.sqrt((centred**2).mean())),
        "slope": (centred @ along).mean() / (along @ along),
        "roughness": _log(np.sqrt(square)),
        "bend": _log(np.sqrt((np.diff(steps) ** 2).mean())),
        "jump": _log(abs(np.diff(values[:, max(start - 2, 0) :], 2)).max()),
        "wander": _log(np.sqrt(((tail[:, lag:] - tail[:, :-lag]) ** 2).mean())),
        "lean": (steps**3).mean() / max(square**1.5, TINY),
    }


def distances(one: np.ndarray, other: np.ndarray, start: int = 0) -> np.ndarray:
    """Return how far two curves (row, sample) are apart from the sample `start` on (DISTANCES)."""
    with np.errstate(invalid="ignore"):  # two infinities are no distance apart
        apart = (one - other)[:, start:]
    apart = apart[np.isfinite(apart)]
    if apart.size < LEAST:
        return np.full(len(DISTANCES), np.nan)
    return np.array([_log(abs(apart).max()), _log(np.sqrt((apart**2).mean()))])


def _log(value: float) -> float:
    return float(np.log(max(value, TINY)))
