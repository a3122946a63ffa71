"""What runs from nearly equal initial conditions can show of the paper's own run.

Runs whose initial conditions differ from the paper's by a millionth cannot show that a difference
of a hundredth would end the motion. The study of breathers counts how many runs spread, by the size
of the difference. A sentence that rests on nearly equal runs holds only if most runs with so small
a difference spread, and it has a caveat if most runs with some larger difference do not.
"""

from typing import NamedTuple

import numpy as np

from .changes import exchange
from .claim import Control
from .criterion import Above, AllOf, Criterion, Finding, judge
from .cutoff import Cutoff

SENSITIVITY = "breathers/sensitivity"
MAJORITY = Cutoff(0.5, '"most": more than half')


class AlmostEqual(NamedTuple):
    """The share of runs that spread from data this close, what it must keep, and a caveat."""

    measured: dict[str, float]
    criterion: Criterion
    caveat: str

    def judge(self, measured: dict[str, float], *criteria: Criterion, caveat: str = "") -> Finding:
        """Return the finding on a sentence for which this share must be large enough as well."""
        every, caveats = AllOf(*criteria, self.criterion), filter(None, (caveat, self.caveat))
        return judge(measured | self.measured, every, "; ".join(caveats))


def almost_equal(sensitivity, within: float) -> AlmostEqual:
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
    says = "least share of equally perturbed runs that spread"
    return AlmostEqual({"share_nearby": least}, Above(MAJORITY, "share_nearby", says=says), caveat)


FAR_AS_NEAR = Control(
    "the shares that spread, with the sizes of the perturbation in reverse order",
    {SENSITIVITY: exchange("size", names=("share", "share_low", "share_high"))},
)
"""A wrong case for every claim that rests on `almost_equal`."""
