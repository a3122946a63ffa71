"""How the deciding functions read trajectories and sweeps."""

from pendula.ledger.verdicts import UndecidableError
from pendula.measures.levels import levelling, rising_share  # noqa: F401
from pendula.measures.levels import relative_range as spread  # noqa: F401
from pendula.measures.norms import constants, growth_margin, largest, mean  # noqa: F401
from pendula.measures.norms import total_power as powers  # noqa: F401

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
    """Return the trajectory from tau = `start` on, which must leave as long a time again."""
    end = float(trajectory["tau"][-1])
    if end < 2.0 * start:
        raise UndecidableError(f"the run ends at tau = {end:g}, before {2.0 * start:g}")
    return trajectory.sel(tau=slice(start, None))


def halves(trajectory):
    """Return the two halves of the late part."""
    settled = late(trajectory)
    middle = 0.5 * (float(settled["tau"][0]) + float(settled["tau"][-1]))
    return settled.sel(tau=slice(None, middle)), settled.sel(tau=slice(middle, None))


def swept(sweep, norm: str, statistic: str, window: str, quantity: str = "pair"):
    """Return (half-widths, values) of one reading of a sweep."""
    if window not in sweep["window"].values:
        raise UndecidableError(f"the sweep has no window {window}")
    values = sweep[norm].sel(quantity=quantity, statistic=statistic, window=window).values
    if len(values) < 6:
        raise UndecidableError("the sweep has fewer than six half-widths")
    return sweep["half_width"].values, values
