"""Made-up shares of runs that spread, by the size of a change of the data."""

import numpy as np
import xarray as xr


def sensitivity(*shares: float, sizes=(1e-8, 1e-6, 1e-3, 1e-1)) -> xr.Dataset:
    """Return shares with limits of a tenth to each side; near the data all runs spread."""
    share = np.array(shares or (1.0, 1.0, 0.4, 0.1))
    return xr.Dataset(
        {
            "share": ("size", share), "share_low": ("size", share - 0.1),
            "share_high": ("size", share + 0.1), "spread": ("initial", [1, 0, 0]),
        },
        {"size": list(sizes), "initial": [4.9, 5.0, 5.1]},
        {"members": 20},
    )  # fmt: skip
