"""Cut-offs, names of datasets and helpers that the claims of several studies share.

Runs perturbed by 1e-6 do not show the effect of perturbations by 1e-2. The study of breathers
therefore measures the share of runs that spread, by the size of the perturbation. A claim on runs
perturbed by up to 1e-6 holds only if most of these runs spread. It gets a caveat if most runs with
some larger perturbation do not.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

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

# ASSUME: one number for each of the paper's words for sizes. All claims share it, so that it is not
# fitted to the data of one claim.
FACTOR = Cutoff(2.0, '"comparable", "the same level", "mix up", "grows": a factor of 2')
MUCH = Cutoff(3.0, '"large", "significantly larger": a factor of 3')
CHANGE = Cutoff(0.25, '"do not change much", "saturates": by less than a quarter')
CONSTANT = Cutoff(0.02, '"does not change": by less than 2 %, which a figure of 5 cm hardly shows')
NEARLY_ALL = Cutoff(0.75, '"nearly monotonic": three of four steps go up', 1.0)

SETTLED = 10.0
"""The tau from which the paper takes its statistics: its time windows start here."""
FEWEST = 6
"""The smallest number of half-widths with which a sweep decides a claim."""


def _in(folder: str) -> Callable[..., tuple[str, ...]]:
    """Return a function that prefixes names of datasets with their folder."""
    return lambda *names: tuple(f"{folder}/{name}" for name in names)


checks, runs = _in("checks"), _in("trajectories")
sweeps, unbounded = _in("sweeps"), _in("unbounded")
SMALL = runs("fig2_small", "fig3_small", "fig4_small")


def late(trajectory: xr.Dataset, start: float = SETTLED) -> xr.Dataset:
    """Return the run from tau = `start` on. Raises UndecidableError if it ends before 2 `start`."""
    end = float(trajectory["tau"][-1])
    if end < 2.0 * start:
        raise UndecidableError(f"the run ends at tau = {end:g}, before {2.0 * start:g}")
    return trajectory.sel(tau=slice(start, None))


def swept(
    sweep: xr.Dataset, norm: str, statistic: str, window: str, quantity: str = "pair"
) -> tuple[np.ndarray, np.ndarray]:
    """Return the half-widths of a sweep, and a statistic of a norm at each half-width.

    Raises UndecidableError if the sweep lacks the window or has fewer than FEWEST half-widths.
    """
    if window not in sweep["window"].values:
        raise UndecidableError(f"the sweep has no window {window}")
    values = sweep[norm].sel(quantity=quantity, statistic=statistic, window=window).values
    if len(values) < FEWEST:
        raise UndecidableError(f"the sweep has fewer than {FEWEST} half-widths")
    return sweep["half_width"].values, values


def at_one_omega(first: xr.Dataset, second: xr.Dataset) -> None:
    """Raise UndecidableError if two runs or sweeps differ in Omega and cannot be compared."""
    if first.attrs["omega"] != second.attrs["omega"]:
        raise UndecidableError("the compared datasets have different values of Omega")


def number(check: xr.Dataset, name: str, **selection: Any) -> float:
    """Return one number of a check's dataset."""
    return float(check[name].sel(selection).values)


# --- Runs from perturbed initial conditions ---

SENSITIVITY = "breathers/sensitivity"
MAJORITY = Cutoff(0.5, '"most": more than half')


class PerturbedShare(NamedTuple):
    """The smallest share of perturbed runs that spread, the criterion on it, and a caveat."""

    measured: dict[str, float]
    criterion: Criterion
    caveat: str

    def judge(self, measured: dict[str, float], *criteria: Criterion, caveat: str = "") -> Finding:
        """Return the finding on a claim that also requires this share to be large enough."""
        every, caveats = AllOf(*criteria, self.criterion), filter(None, (caveat, self.caveat))
        return judge(measured | self.measured, every, "; ".join(caveats))


def almost_equal(sensitivity: xr.Dataset, within: float) -> PerturbedShare:
    """Return the smallest share of runs that spread, over relative perturbations up to `within`.

    If all perturbations are larger than `within`, only the smallest one counts.
    """
    sizes = sensitivity["size"].values
    share, high = (sensitivity[name].values for name in ("share", "share_high"))
    near = sizes <= max(within * 1.001, sizes.min())
    least, caveat = float(share[near].min()), ""
    # larger sizes at which most runs do not spread, preferably by the whole confidence interval
    below = [~near & (high < MAJORITY.value), ~near & (share <= MAJORITY.value)]
    if firsts := [np.flatnonzero(sizes_below)[0] for sizes_below in below if sizes_below.any()]:
        caveat = (
            "only near the printed amplitudes: the share of runs that spread is"
            f" {least:.0%} for perturbations up to {sizes[near].max():g}, but"
            f" {share[firsts[0]]:.0%} for {sizes[firsts[0]]:g}"
        )
    label = "smallest share of perturbed runs that spread"
    return PerturbedShare(
        {"share_nearby": least}, Above(MAJORITY, "share_nearby", label=label), caveat
    )


FAR_AS_NEAR = ClaimControl(
    "the shares that spread, with the sizes of the perturbation in reverse order",
    {SENSITIVITY: exchange("size", names=("share", "share_low", "share_high"))},
)
"""The control of every claim that uses `almost_equal`."""
