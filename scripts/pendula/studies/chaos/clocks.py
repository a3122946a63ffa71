"""Names of the numbers measured in each run, and their medians or means by initial amplitude.

The module imports no solver: figures and claims do not depend on the code of solvers.
"""

import numpy as np
import xarray as xr
from latticode.measures.confidence import CONFIDENCE, ConfidenceInterval, mean_limits, median_limits

NUMBERS = {
    "transition": "time at which P first reaches half of its final value",
    "life": "time at which the central pair first holds at most P / N, infinite if after the end",
    "centre_share": "share of P on the central pair, mean over the window",
    "l2": "l2 norm over the chain, mean over the window",
    "linf": "l-infinity norm over the chain, mean over the window",
}
"""Numbers measured in each run."""
TIMES = ("transition", "life")
"""Times. They may be later than the end of a run, so ensembles have medians of them, not means."""


def limits_of(
    lifetimes: xr.Dataset, confidence: float = CONFIDENCE
) -> dict[str, ConfidenceInterval]:
    """Return medians of times and means of other numbers, with limits, (start_amplitude,)."""
    return {
        name: ConfidenceInterval(
            *np.transpose(
                [
                    (median_limits if name in TIMES else mean_limits)(values, confidence)
                    for values in lifetimes[name].transpose("start_amplitude", "member").values
                ]
            )
        )
        for name in NUMBERS
    }
