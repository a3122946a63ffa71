"""Cut-offs, names of datasets and helpers that the claims of several studies share.

Runs with relative perturbations of 1e-6 cannot show that one of 1e-2 would end the motion. The
study of breathers measures the share of runs that spread, by the size of the perturbation. A claim
on perturbed runs holds only if most runs with perturbations of that size spread, and it has a
caveat if most runs with some larger perturbation do not.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import xarray as xr
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
    """Return a function that prefixes names of datasets with their folder."""
    return lambda *names: tuple(f"{folder}/{name}" for name in names)


checks, runs = _in("checks"), _in("trajectories")
sweeps, unbounded = _in("sweeps"), _in("unbounded")
SMALL = runs("fig2_small", "fig3_small", "fig4_small")


def late(trajectory: xr.Dataset, start: float = SETTLED) -> xr.Dataset:
    """Return the trajectory from tau = `start` on.

    Raises UndecidableError if it ends before 2 `start`.
    """
    end = float(trajectory["tau"][-1])
    if end < 2.0 * start:
        raise UndecidableError(f"the run ends at tau = {end:g}, before {2.0 * start:g}")
    return trajectory.sel(tau=slice(start, None))


def swept(
    sweep: xr.Dataset, norm: str, statistic: str, window: str, quantity: str = "pair"
) -> tuple[np.ndarray, np.ndarray]:
    """Return the half-widths of a sweep and a statistic of a norm at each.

    Raises UndecidableError if the sweep has not the window, or fewer than FEWEST half-widths.
    """
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
    """The share of perturbed runs that spread, the criterion on it, and a caveat."""

    measured: dict[str, float]
    criterion: Criterion
    caveat: str

    def judge(self, measured: dict[str, float], *criteria: Criterion, caveat: str = "") -> Finding:
        """Return the finding on a claim that also requires this share to be large enough."""
        every, caveats = AllOf(*criteria, self.criterion), filter(None, (caveat, self.caveat))
        return judge(measured | self.measured, every, "; ".join(caveats))


def almost_equal(sensitivity, within: float) -> PerturbedShare:
    """Return the share of runs that spread with relative perturbations up to `within`.

    If no perturbation was that small, the smallest one is used.
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
