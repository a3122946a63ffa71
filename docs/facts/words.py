"""How facts write times, errors and limits."""

import numpy as np
import xarray as xr
from pendula.report.words import number, percent, with_error


def time_of_output(tau) -> str:
    """Return a time of an output, whose step of 0.025 five digits tell in single precision too."""
    return number(tau, 5) if np.isfinite(tau) else "never"


def with_stored_error(data: xr.Dataset, name: str) -> str:
    return with_error(float(data[name]), float(data[f"{name}_error"]))


def from_to(low: xr.DataArray, high: xr.DataArray, **at) -> str:
    return " to ".join(percent(one.sel(at)) for one in (low, high))


def with_limits(one, name: str, write) -> str:
    """Return a number with its confidence limits; a dash where it is not known."""
    values = [float(one[f"{name}{end}"]) for end in ("", "_low", "_high")]
    if np.isnan(values[0]):
        return "-"
    value, low, high = map(write, values)
    return f"{value} ({low} to {high})"
