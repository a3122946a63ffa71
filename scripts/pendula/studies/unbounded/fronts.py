"""The speed of a front, measured from where it is at the ends of the pieces."""

import numpy as np

FRONT, SEA = 1e-2, 4.0
"""Powers at which a front is found: of a pulled one, and of a sea within waves that it radiates."""

SETTLED = 1 / 3
"""The part of a run that is left out: at first the speed is below the one it tends to."""


def speed_of(tau: np.ndarray, front: np.ndarray) -> float:
    """Return the slope of the front's site over time, of the late part of a run."""
    late = tau >= SETTLED * tau[-1]
    return float(np.polyfit(tau[late], front[late], 1)[0])


def speeds(run, level: float = FRONT, corrected: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return the speeds of each variant of a dataset of runs, mean over members, and their errors.

    `corrected` adds back what a pulled front loses on its way, `predicted_delay` log tau. The
    error is one site over the time of the fit at least: a front stands on sites.
    """
    tau = run["piece_tau"].values
    way = run["front"].sel(level=level).transpose("variant", "member", "piece_tau").values
    if corrected:
        way = way + run["predicted_delay"].values[:, None, None] * np.log(tau)
    found = np.array([[speed_of(tau, series) for series in members] for members in way])
    least = 1.0 / ((1.0 - SETTLED) * tau[-1])
    if found.shape[1] == 1:
        return found[:, 0], np.full(len(found), least)
    spread = found.std(axis=1, ddof=1) / np.sqrt(found.shape[1])
    return found.mean(axis=1), np.maximum(spread, least)
