"""Which cases are chaotic, as the verdicts need it: by cut-offs that can be moved."""

import xarray as xr

from pendula.measures.growth import ERRORS, MANY, is_chaotic
from pendula.numerics.elementary import log

from .cutoff import Cutoff

MUCH_GROWTH = Cutoff(MANY, "logarithm of a growth by a hundred, where tau^6 has grown by 64")
SURE = Cutoff(ERRORS, "three standard errors, which chance exceeds a few times in a thousand")


def chaotic(lyapunov: xr.Dataset) -> xr.DataArray:
    """Return whether tangent vectors of either parity grow exponentially, (case).

    The dataset says it too, by the same limits; here they can move.
    """
    growth = lyapunov["log_growth"].transpose("case", "parity", "tau")
    size = lyapunov["l2"].transpose("case", "tau").values[:, None]
    limits = {"many": MUCH_GROWTH.value, "errors": SURE.value}
    found = is_chaotic(growth["tau"].values, growth.values, size, **limits)
    return lyapunov["case"].copy(data=found.any(axis=1)).rename("chaotic")


def regular(lyapunov: xr.Dataset) -> xr.Dataset:
    """Return exponents of the same cases as if nothing grew, for controls."""
    size = lyapunov["l2"].copy(data=log(lyapunov["l2"].values))
    return lyapunov.assign(log_growth=size + 0.0 * lyapunov["log_growth"])
