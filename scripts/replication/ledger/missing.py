"""Missing data, which cannot confirm a claim: unknown numbers, and series of too few samples.

Reductions that skip NaN would hide that half of a dataset is unknown, and two points are always on
a line. So confirming findings from such data are withdrawn, by one rule for all claims. Data with
gaps may still refute a claim, because one counterexample is enough.
"""

from collections.abc import Iterable, Mapping

import numpy as np
import xarray as xr

from replication.variables import MISSING, SAMPLES

from .cutoff import once

FEWEST = 3
"""Default of the fewest samples along a coordinate: two are always on a line."""


def missing(
    names: Iterable[str], datasets: Mapping[str, xr.Dataset], on: tuple[str, ...] = ()
) -> str:
    """Return what is missing from these datasets to confirm a claim; empty if nothing is.

    `on` names the cases and sweeps that are used, if a dataset has others as well.
    """
    return "; ".join(
        f"{lack} of {name}"
        for name in names
        if isinstance(datasets[name], xr.Dataset)
        for lack in _missing(datasets[name], on)
    )


@once
def _missing(dataset: xr.Dataset, on: tuple[str, ...]) -> list[str]:
    several = [along for along in ("case", "sweep") if along in dataset.indexes]
    labels = {along: [label for label in dataset[along].values if label in on] for along in several}
    dataset = dataset.sel(labels) if any(labels.values()) else dataset
    unknown = [
        f"{name} is unknown in part"
        for name, values in dataset.data_vars.items()
        if MISSING not in values.attrs and values.dtype.kind in "fc"
        if np.isnan(values.values).any()
    ]
    return unknown + [
        f"{name} has fewer than {fewest} samples"
        for name, coordinate in dataset.coords.items()
        if coordinate.dims == (name,) and coordinate.dtype.kind in "fiu"
        if coordinate.size < (fewest := int(coordinate.attrs.get(SAMPLES, FEWEST)))
    ]
