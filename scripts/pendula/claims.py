"""What claims of several studies share: the paper's words for sizes, its runs, its perturbed runs.

Runs whose initial conditions differ from the paper's by a millionth cannot show that a difference
of a hundredth would end the motion. The study of breathers counts how many runs spread, by the size
of the difference. A sentence that rests on perturbed runs holds only if most runs with so small a
difference spread, and it has a caveat if most runs with some larger difference do not.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from replication.ledger.changes import exchange
from replication.ledger.claim import ClaimControl
from replication.ledger.criterion import (
    Above,
    AllOf,
    Criterion,
    Finding,
    UndecidableError,
    judge,
)
from replication.ledger.cutoff import Cutoff

# ASSUME: the paper's words for sizes, one measure for each word wherever it stands, so
# that none is fitted to the numbers of one row.
FACTOR = Cutoff(2.0, '"comparable", "the same level", "mix up", "grows": a factor of 2')
MUCH = Cutoff(3.0, '"large", "significantly larger": a factor of 3')
CHANGE = Cutoff(0.25, '"do not change much", "saturates": by less than a quarter')
CONSTANT = Cutoff(0.02, '"does not change": by less than 2 %, which a figure of 5 cm hardly shows')
NEARLY_ALL = Cutoff(0.75, '"nearly monotonic": three of four steps go up', 1.0)

SETTLED = 10.0
"""The paper takes its statistics from here on: its time windows start at tau = 10."""
FEWEST = 6
"""A sweep with fewer half-widths decides nothing."""


def _in(folder: str) -> Callable[..., tuple[str, ...]]:
    """Return a function that takes names and returns those of the datasets in a folder."""
    return lambda *names: tuple(f"{folder}/{name}" for name in names)


checks, runs = _in("checks"), _in("trajectories")
sweeps, unbounded = _in("sweeps"), _in("unbounded")
SMALL = runs("fig2_small", "fig3_small", "fig4_small")


def late(trajectory, start: float = SETTLED):
    """Return the trajectory from tau = `start` on, which must leave as long a time again."""
    end = float(trajectory["tau"][-1])
    if end < 2.0 * start:
        raise UndecidableError(f"the run ends at tau = {end:g}, before {2.0 * start:g}")
    return trajectory.sel(tau=slice(start, None))


def swept(sweep, norm: str, statistic: str, window: str, quantity: str = "pair"):
    """Return the half-widths of a sweep and one statistic of a norm of the pair at each."""
    if window not in sweep["window"].values:
        raise UndecidableError(f"the sweep has no window {window}")
    values = sweep[norm].sel(quantity=quantity, statistic=statistic, window=window).values
    if len(values) < FEWEST:
        raise UndecidableError(f"the sweep has fewer than {FEWEST} half-widths")
    return sweep["half_width"].values, values


def at_one_omega(one, other) -> None:
    """Raise an error unless two runs or sweeps are at one Omega, as a comparison of them is."""
    if one.attrs["omega"] != other.attrs["omega"]:
        raise UndecidableError("these data are at two values of Omega")


def number(check, name: str, **selection) -> float:
    """Return one number of a check's dataset."""
    return float(check[name].sel(selection).values)


# --- Runs from perturbed initial conditions ---

SENSITIVITY = "breathers/sensitivity"
MAJORITY = Cutoff(0.5, '"most": more than half')


class PerturbedShare(NamedTuple):
    """The share of runs that spread from data this close, what it must keep, and a caveat."""

    measured: dict[str, float]
    criterion: Criterion
    caveat: str

    def judge(self, measured: dict[str, float], *criteria: Criterion, caveat: str = "") -> Finding:
        """Return the finding on a sentence for which this share must be large enough as well."""
        every, caveats = AllOf(*criteria, self.criterion), filter(None, (caveat, self.caveat))
        return judge(measured | self.measured, every, "; ".join(caveats))


def almost_equal(sensitivity, within: float) -> PerturbedShare:
    """Return what the shares that spread say of an ensemble whose data are `within` the paper's.

    Where no change that small was tried, the smallest that was stands for it.
    """
    sizes = sensitivity["size"].values
    share, high = (sensitivity[name].values for name in ("share", "share_high"))
    near = sizes <= max(within * 1.001, sizes.min())
    least, caveat = float(share[near].min()), ""
    lost = [high < MAJORITY.value, share <= MAJORITY.value]  # surely, or as far as is known
    if found := [np.flatnonzero(one & ~near)[0] for one in lost if (one & ~near).any()]:
        caveat = (
            "only near the printed amplitudes: the share of runs that spread is"
            f" {least:.0%} for perturbations up to {sizes[near].max():g}, but"
            f" {share[found[0]]:.0%} for {sizes[found[0]]:g}"
        )
    label = "least share of equally perturbed runs that spread"
    return PerturbedShare(
        {"share_nearby": least}, Above(MAJORITY, "share_nearby", label=label), caveat
    )


FAR_AS_NEAR = ClaimControl(
    "the shares that spread, with the sizes of the perturbation in reverse order",
    {SENSITIVITY: exchange("size", names=("share", "share_low", "share_high"))},
)
"""A wrong case for every claim that rests on `almost_equal`."""
