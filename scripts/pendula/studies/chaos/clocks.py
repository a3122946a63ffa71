"""What is kept of each run from an initial amplitude, and its medians and means over members.

It needs no solver, so that figures and claims do not depend on how the runs were integrated.
"""

import numpy as np
import xarray as xr
from latticode.measures.confidence import CONFIDENCE, Limits, mean_limits, median_limits

NUMBERS = {
    "transition": "time at which P first reaches half of its final value",
    "life": "time at which the central pair first holds at most P / N, infinite if after the end",
    "centre_share": "share of P on the central pair, mean over the window",
    "l2": "l2 norm over the chain, mean over the window",
    "linf": "l-infinity norm over the chain, mean over the window",
}
"""What is kept of each run."""
TIMES = ("transition", "life")
"""Those whose median is taken, as a time may never come."""


def limits_of(lifetimes: xr.Dataset, confidence: float = CONFIDENCE) -> dict[str, Limits]:
    """Return the median times and the means over members with their limits, (start_amplitude,)."""
    return {
        name: Limits(
            *np.transpose(
                [
                    (median_limits if name in TIMES else mean_limits)(values, confidence)
                    for values in lifetimes[name].transpose("start_amplitude", "member").values
                ]
            )
        )
        for name in NUMBERS
    }
