"""What verdicts need of chaos: which cases are chaotic, and what an ensemble says of other data.

An ensemble whose data are within a millionth of the paper's cannot see that a change of a hundredth
would end the motion that it measures. The study of breathers counts which runs spread by the size
of a change, and a sentence that rests on such an ensemble is held to these counts: it holds
if most of the data that close do what the paper's do, and it has a caveat if data further away do
not.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr
from latticode.measures.growth import ERRORS, MANY, is_chaotic
from latticode.numerics.elementary import log

from .changes import exchange
from .claim import Control
from .criterion import Above, AllOf, Criterion, Finding, judge
from .cutoff import Cutoff, once

MUCH_GROWTH = Cutoff(MANY, "logarithm of a growth by a hundred, where tau^6 has grown by 64")
SURE = Cutoff(ERRORS, "three standard errors, which chance exceeds a few times in a thousand")


@once
def chaotic(lyapunov: xr.Dataset) -> xr.DataArray:
    """Return whether tangent vectors grow exponentially along any member of a case, (case).

    The dataset says it too, by the same limits; here they are cut-offs, which can move.
    """
    along = ("case", "member", "tau")
    growth, size = (lyapunov[name].transpose(*along) for name in ("log_growth", "l2"))
    limits = {"many": MUCH_GROWTH.value, "errors": SURE.value}
    found = is_chaotic(growth["tau"].values, growth.values, size.values, **limits)
    return lyapunov["case"].copy(data=found.any(axis=1)).rename("chaotic")


def regular(lyapunov: xr.Dataset) -> xr.Dataset:
    """Return exponents of the same cases as if nothing grew, for controls."""
    size = lyapunov["l2"].copy(data=log(lyapunov["l2"].values))
    return lyapunov.assign(log_growth=size)


SENSITIVITY = "breathers/sensitivity"
MAJORITY = Cutoff(0.5, '"most": more than half')


class AlmostEqual(NamedTuple):
    """The share of runs that spread from data this close, what it must keep, and a caveat."""

    measured: dict[str, float]
    criterion: Criterion
    caveat: str

    def judge(self, measured: dict[str, float], *criteria: Criterion, caveat: str = "") -> Finding:
        """Return the finding on a sentence for which this share must be large enough as well."""
        every = AllOf(*criteria, self.criterion)
        return judge(measured | self.measured, every, joined(caveat, self.caveat))


def almost_equal(sensitivity, within: float) -> AlmostEqual:
    """Return what the shares that spread say of an ensemble whose data are `within` the paper's.

    Where no change that small was tried, the smallest that was stands for it.
    """
    sizes = sensitivity["size"].values
    share, high = (sensitivity[name].values for name in ("share", "share_high"))
    near = sizes <= max(within * 1.001, sizes.min())
    measured = {"share_nearby": float(share[near].min())}
    criterion = Above(
        MAJORITY, "share_nearby", says="least share of equally perturbed runs that spread"
    )
    lost = (high < MAJORITY.value) & ~near
    if lost.any():
        least = int(np.argmin(np.where(lost, sizes, np.inf)))
        caveat = (
            "only near the printed amplitudes: the share of runs that spread is"
            f" {share[near].min():.0%} for perturbations up to {sizes[near].max():g}, but"
            f" {share[least]:.0%} for {sizes[least]:g}"
        )
    elif share[~near].min(initial=1.0) > MAJORITY.value:
        caveat = ""
    else:
        caveat = f"shown only for initial conditions within {within:g} of the paper's"
    return AlmostEqual(measured, criterion, caveat)


FAR_AS_NEAR = Control(
    "the shares that spread, with the sizes of the perturbation in reverse order",
    {SENSITIVITY: exchange("size", names=("share", "share_low", "share_high"))},
)
"""A wrong case for every claim that rests on `almost_equal`."""


def joined(*caveats: str) -> str:
    """Return several caveats as one."""
    return "; ".join(filter(None, caveats))
