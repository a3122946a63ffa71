"""What ensembles of almost equal data may say of data that differ by more.

An ensemble whose data are within a millionth of the paper's cannot see that a change of a hundredth
would end the motion that it measures. The study of breathers counts which runs spread by the size
of a change, and a sentence that rests on such an ensemble is held to these counts: it holds
if most of the data that close do what the paper's do, and it has a caveat if data further away do
not.
"""

from typing import NamedTuple

import numpy as np

from .claim import Control
from .criterion import Above, Criterion
from .cutoff import Cutoff

SENSITIVITY = "breathers/sensitivity"
MAJORITY = Cutoff(0.5, '"most": more than half')


class AlmostEqual(NamedTuple):
    """The share of runs that spread from data this close, what it must keep, and a caveat."""

    measured: dict[str, float]
    criterion: Criterion
    caveat: str


def almost_equal(sensitivity, within: float) -> AlmostEqual:
    """Return what the shares that spread say of an ensemble whose data are `within` the paper's.

    Where no change that small was tried, the smallest that was stands for it.
    """
    sizes = sensitivity["size"].values
    share, high = (sensitivity[name].values for name in ("share", "share_high"))
    near = sizes <= max(within * 1.001, sizes.min())
    measured = {"share_nearby": float(share[near].min())}
    criterion = Above(
        MAJORITY, "share_nearby", says="least share that spreads of data changed as little"
    )
    lost = (high < MAJORITY.value) & ~near
    if lost.any():
        least = int(np.argmin(np.where(lost, sizes, np.inf)))
        caveat = (
            f"an accident of the digits: {share[least]:.0%} of runs from data changed by"
            f" {sizes[least]:g} spread; where data are changed by {sizes[near].max():g} or less,"
            f" the least share is {share[near].min():.0%}"
        )
    elif share[~near].min(initial=1.0) > MAJORITY.value:
        caveat = ""
    else:
        caveat = f"the data are within {within:g} of the paper's: it says nothing of others"
    return AlmostEqual(measured, criterion, caveat)


def from_the_other_end(sensitivity):
    """Return the shares under sizes in reverse order: what is close to the data does not spread."""
    names = [name for name in ("share", "share_low", "share_high") if name in sensitivity]
    return sensitivity.assign({name: ("size", sensitivity[name].values[::-1]) for name in names})


FAR_AS_NEAR = Control(
    "the shares that spread of the sizes in reverse order", {SENSITIVITY: from_the_other_end}
)
"""A wrong case for every claim that rests on `almost_equal`."""


def joined(*caveats: str) -> str:
    """Return several caveats as one."""
    return "; ".join(filter(None, caveats))
