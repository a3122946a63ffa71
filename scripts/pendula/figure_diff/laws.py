"""Laws that hold between the numbers of a dataset, also of a chaotic one.

A law that the accepted run obeys holds in every right run: a bound stays above what it bounds, what
only grows goes on growing. A jump in time is larger than any step of the accepted run.
"""

import re
from collections.abc import Iterator
from itertools import product

import numpy as np
import xarray as xr

from .values import rows

ROUNDED = 1e-5
"""How far equal numbers may be apart, relative to the largest: accepted ones have seven digits."""

TIMES = ("tau", "snapshot", "snapshot_tau")
STEP, FEWEST = 3.0, 20
"""How much larger a step in time may be than the largest accepted one; FEWEST times make a run."""

PAIRS = (("linf", "l2"), ("_low", ""), ("", "_high"), ("_low", "_high"))
"""Endings or parts of names: the first variable is never larger than the second."""

NO_NORM = ("deviation", "error")

_GROWS = re.compile("so_far|passed|turns")
"""Names of what can only grow in time."""


def broken(was: xr.Dataset, now: xr.Dataset) -> list[str]:
    """Return in words the laws that the accepted run obeys and the new one does not."""
    obeyed = dict(_laws(was))
    return [law for law, holds in _laws(now) if not holds and obeyed.get(law)] + [*_jumps(was, now)]


def _laws(data: xr.Dataset) -> Iterator[tuple[str, bool]]:
    """Yield each law that can be looked at, and whether it holds."""
    floats = {k: v for k, v in data.variables.items() if v.dtype.kind == "f"}
    for (less, more), key in product(PAIRS, floats):
        other = key.replace(less, more) if less else f"{key}{more}"
        alike = other in floats and other != key and floats[key].dims == floats[other].dims
        if alike and not key.endswith(NO_NORM):
            yield f"{key} is larger than {other}", _below(floats[key], floats[other])
    for key, variable in floats.items():
        grown = "tau" if _GROWS.search(key) else "quantile"
        for dim in [grown] if grown in variable.dims else ():
            steps = np.diff(variable.values, axis=variable.get_axis_num(dim))
            grows = not (steps < -ROUNDED * _largest(variable.values)).any()
            yield f"{key} does not only grow along {dim}", grows


def _below(less: xr.Variable, more: xr.Variable) -> bool:
    return not (less.values > more.values + ROUNDED * _largest(less.values)).any()


def _jumps(was: xr.Dataset, now: xr.Dataset) -> Iterator[str]:
    for key, variable in was.variables.items():
        times = [dim for dim in TIMES if variable.sizes.get(dim, 0) >= FEWEST]
        for dim in times if variable.dtype.kind == "f" else ():
            axis, rounded = variable.get_axis_num(dim), ROUNDED * _largest(variable.values)
            steps = [abs(np.diff(data[key].values, axis=axis)) for data in (was, now)]
            for row in rows(variable, was):
                before, after = (_largest(each[row]) for each in steps)
                if after > STEP * before + rounded:
                    yield f"{key} jumps along {dim}"
                    break


def _largest(values: np.ndarray) -> float:
    return float(np.fmax.reduce(abs(values), axis=None, initial=0.0))
