"""How the deciding functions read trajectories and sweeps."""

import numpy as np

from pendula.ledger.verdicts import UndecidableError
from pendula.problem import Constants

# ASSUME: the paper's words for sizes, one measure for each word wherever it stands, so
# that none is fitted to the numbers of one row. "Comparable", "the same level", "no drastic
# difference": within a factor of 2; "grows", "mix up" likewise. "Significantly larger", "large":
# by a factor of 3. "Do not change much", "saturates", "no significant" or "no visible
# difference": by less than 25 %. "Does not change": by less than 2 %; what changes by more than
# that in one direction "decreases". "Nearly monotonic": three of four steps.
FACTOR, MUCH, CHANGE, CONSTANT, NEARLY_ALL = 2.0, 3.0, 0.25, 0.02, 0.75

SETTLED = 10.0
"""From here on the paper's own statistics are taken: its windows start at tau = 10."""


def late(trajectory, start: float = SETTLED):
    """Return the trajectory from tau = `start` on, which must leave as long a stretch again."""
    end = float(trajectory["tau"][-1])
    if end < 2.0 * start:
        raise UndecidableError(f"the run ends at tau = {end:g}, before {2.0 * start:g}")
    return trajectory.sel(tau=slice(start, None))


def halves(trajectory):
    """Return the two halves of the late part."""
    settled = late(trajectory)
    middle = 0.5 * (float(settled["tau"][0]) + float(settled["tau"][-1]))
    return settled.sel(tau=slice(None, middle)), settled.sel(tau=slice(middle, None))


def powers(trajectory) -> np.ndarray:
    """Return P = |A|^2 + |B|^2 in l2 at all times."""
    return (trajectory["l2"] ** 2).sum("component").values


def growth_margin(tau: np.ndarray, l2: np.ndarray, gamma: float) -> dict[str, float]:
    """Return how close a trajectory with norms `l2`, shape (2, time), comes to the bound (19).

    `from_start`: largest P(tau) / (P(0) e^{4 |gamma| tau}) over tau > 0; `backwards`: the same
    seen from the end; `steepest`: largest |change of log P| over 4 |gamma| times its duration,
    one for any pair of times at the bound. All must be at most one.
    """
    rise = np.log(np.sum(np.asarray(l2) ** 2, axis=0))
    allowed = 4.0 * abs(gamma) * np.asarray(tau, dtype=float)
    forth = (rise - rise[0]) - (allowed - allowed[0])
    back = (rise - rise[-1]) - (allowed[-1] - allowed)
    steps = np.abs(np.diff(rise))
    bound = np.diff(allowed)
    unbounded = np.where(steps > 0, np.inf, 0.0)  # without a drive P may not move at all
    steepest = np.where(bound > 0, steps / np.where(bound > 0, bound, 1.0), unbounded)
    return {
        "from_start": float(np.exp(forth[1:].max())),
        "backwards": float(np.exp(back[:-1].max())),
        "steepest": float(steepest.max()),
    }


def largest(trajectory) -> np.ndarray:
    """Return the l-infinity norm of the pair at all times."""
    return trajectory["linf"].max("component").values


def mean(trajectory, name: str, component: str) -> float:
    """Return the mean of a norm of one component over time."""
    return float(trajectory[name].sel(component=component).mean())


def constants(dataset) -> Constants:
    """Return the constants of a trajectory or a sweep."""
    return Constants.of(dataset.attrs)


def swept(sweep, norm: str, statistic: str, window: str, quantity: str = "pair"):
    """Return (half-widths, values) of one reading of a sweep."""
    if window not in sweep["window"].values:
        raise UndecidableError(f"the sweep has no window {window}")
    values = sweep[norm].sel(quantity=quantity, statistic=statistic, window=window).values
    if len(values) < 6:
        raise UndecidableError("the sweep has fewer than six half-widths")
    return sweep["half_width"].values, values


def spread(values: np.ndarray) -> float:
    """Return the range of the values over their mean."""
    return float((np.max(values) - np.min(values)) / abs(np.mean(values)))


def levelling(half_widths: np.ndarray, values: np.ndarray, tolerance: float = 5e-3) -> float:
    """Return the half-width from which all values equal the last to `tolerance`, inf if none.

    The last value alone says nothing: three must agree.
    """
    # ASSUME: the paper gives no measure of "approaches a level"; half a percent is a line's width
    near = np.abs(values / values[-1] - 1.0) <= tolerance
    first = len(values) - int(np.argmin(near[::-1])) if not near.all() else 0
    return float(half_widths[first]) if first <= len(values) - 3 else np.inf


def rising_share(values: np.ndarray) -> float:
    """Return the share of steps that go up, 0 of a single value."""
    return float(np.mean(np.diff(values) > 0)) if len(values) > 1 else 0.0
