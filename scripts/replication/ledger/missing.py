"""What is missing cannot confirm a claim: numbers that are unknown, and series of too few samples.

What is there may still refute a claim, for which one counterexample is enough. So only a finding
that confirms is taken back, for every claim alike: reductions that skip NaN would hide that half of
a dataset is unknown, and a line through two points is no law.
"""

from collections.abc import Iterable, Mapping

import numpy as np
import xarray as xr

from .cutoff import once

FEWEST = 3
"""So many samples at least: any two of them make a line."""
SERIES = (
    "tau piece_tau long_tau end output generation step half_width sites gamma frequency size "
    "initial start_amplitude a0 b0 distance decay sample point proof wave modulus"
)
"""The coordinates along which a claim is on many samples."""
MEANT = "NaN: "
"""Long names with these words say what NaN means; the functions that read these variables know."""


def missing(
    names: Iterable[str], datasets: Mapping[str, xr.Dataset], on: tuple[str, ...] = ()
) -> str:
    """Return what of these datasets is too little to confirm anything, empty if nothing is.

    `on` names the cases and sweeps that are read, where a dataset holds others as well.
    """
    return "; ".join(
        f"{what} of {name}"
        for name in names
        if isinstance(datasets[name], xr.Dataset)
        for what in _missing(datasets[name], on)
    )


@once
def _missing(dataset: xr.Dataset, on: tuple[str, ...]) -> list[str]:
    several = [along for along in ("case", "sweep") if along in dataset.indexes]
    read = {along: [one for one in dataset[along].values if one in on] for along in several}
    dataset = dataset.sel(read) if any(read.values()) else dataset
    unknown = [
        f"{variable} is unknown in part"
        for variable, values in dataset.data_vars.items()
        if MEANT not in values.attrs.get("long_name", "") and values.dtype.kind in "fc"
        if np.isnan(values.values).any()
    ]
    few = [one for one in SERIES.split() if dataset.sizes.get(one, FEWEST) < FEWEST]
    return [*unknown, *(f"{along} has fewer than {FEWEST} samples" for along in few)]
