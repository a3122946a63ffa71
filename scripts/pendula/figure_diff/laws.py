"""Laws that hold between the numbers of a dataset, also of a chaotic one, and between datasets.

A law that the accepted run obeys holds in every right run: a bound stays above what it bounds, what
only grows goes on growing, norms are those of the moduli beside them, a figure shows the dataset
that it is made of. A jump in time is larger than any step of the accepted run.
"""

import re
from collections.abc import Iterator, Mapping
from itertools import product

import numpy as np
import xarray as xr
from latticode.drawing.shown_data import Rows

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
    return [law for law, holds in _laws(now) if not holds and obeyed.get(law)] + _jumps(was, now)


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
    if {"modulus", "snapshot_tau", "linf", "l2"} <= floats.keys() and "site" in data.dims:
        yield from _norms(data)


def _below(less: xr.Variable, more: xr.Variable) -> bool:
    return not (less.values > more.values + ROUNDED * _largest(less.values)).any()


def _norms(data: xr.Dataset) -> Iterator[tuple[str, bool]]:
    """Yield whether the norms at the snapshots are those of the moduli."""
    at = data["snapshot_tau"].values
    moduli = data["modulus"].transpose("component", "snapshot", "site").values
    for key, found in {"linf": moduli.max(-1), "l2": np.sqrt((moduli**2).sum(-1))}.items():
        norms = data[key].transpose("component", "tau")
        here = np.abs(data["tau"].values[:, None] - at).argmin(axis=0)
        apart = abs(norms.values[:, here] - found).max()
        yield f"{key} is not that of the moduli", apart <= ROUNDED * found.max()


def _jumps(was: xr.Dataset, now: xr.Dataset) -> list[str]:
    said = []
    for key, variable in was.variables.items():
        times = [
            d for d in ("tau", "snapshot", "snapshot_tau") if variable.sizes.get(d, 0) >= FEWEST
        ]
        for dim in times if variable.dtype.kind == "f" else ():
            before, after = (
                abs(np.diff(d[key].values, axis=variable.get_axis_num(dim))) for d in (was, now)
            )
            for row in rows(variable, was):
                steps = _largest(before[row]), _largest(after[row])
                if steps[1] > STEP * steps[0] + ROUNDED * _largest(variable.values):
                    said.append(f"{key} jumps along {dim}")
                    break
    return said


def _largest(values: np.ndarray) -> float:
    return float(np.fmax.reduce(abs(values), axis=None, initial=0.0))


def copied(
    was: xr.Dataset, now: xr.Dataset, sources: Mapping[str, tuple[Rows, ...]]
) -> Iterator[str]:
    """Yield the rows that the accepted dataset has from a source, and the new one has not.

    `sources` are the rows of other datasets, by name: accepted, and new.
    """
    for key, variable in was.variables.items():
        if variable.dtype.kind != "f" or not variable.ndim or variable.shape[-1] < FEWEST:
            continue
        for place in np.ndindex(variable.shape[:-1]):
            for name, (old, new) in sources.items():
                whence = old.name(variable.values[place])
                if whence and new.name(now[key].values[place]) != whence:
                    yield f"{key} is not {whence} of {name}"
