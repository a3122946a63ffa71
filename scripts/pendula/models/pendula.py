"""Newton's equations (1) of the pendula, by kicks and drifts; nothing is shared with (4)."""

import numpy as np

from pendula.compiled import inlined_by_llvm, kernel
from pendula.numerics import elementary
from pendula.numerics.elementary import HALF_PI

sine_near_zero, cosine_near_zero = map(
    inlined_by_llvm, (elementary.sine_near_zero, elementary.cosine_near_zero)
)


@inlined_by_llvm
def sine(x):
    """Return sin(x), with the same bits everywhere, for angles of up to thousands of turns."""
    quarters = np.rint(x / HALF_PI[0])
    near, rest = (x - quarters * HALF_PI[0]) - quarters * HALF_PI[1], -quarters * HALF_PI[2]
    odd = quarters % 2.0 == 1.0
    value = cosine_near_zero(near, rest) if odd else sine_near_zero(near, rest)
    return -value if quarters % 4.0 >= 2.0 else value


@inlined_by_llvm
def drift(x, h, v):
    """Move the angles freely for the time `h`."""
    for i in range(x.shape[0]):
        for own in range(2):
            for site in range(x.shape[2]):
                x[i, own, site] += h * v[i, own, site]


@kernel
def move(bonds, drive, drifts, kicks, x, v):
    """Carry angles `x` and velocities `v` (run, pendulum x or y, site) along (1) by steps of BM6.

    For each run `bonds` is C, and `drive` (step, stage, run) is D at the time of each stage. The
    ends of the chain are at rest.
    """
    for step in range(drive.shape[0]):
        for stage in range(kicks.size):
            drift(x, drifts[stage], v)
            for i in range(x.shape[0]):
                for own in range(2):
                    for site in range(x.shape[2]):
                        here = x[i, own, site]
                        left = x[i, own, site - 1] if site > 0 else 0.0
                        right = x[i, own, site + 1] if site < x.shape[2] - 1 else 0.0
                        force = drive[step, stage, i] * (x[i, 1 - own, site] - here)
                        force += bonds[i] * ((right + left) - 2.0 * here) - sine(here)
                        v[i, own, site] += kicks[stage] * force
        drift(x, drifts[0], v)
