"""What is missing cannot confirm a claim: numbers that are unknown, and series of too few samples.

What is there may still refute a claim, for which one counterexample is enough. So only a finding
that confirms is taken back, for every claim alike: reductions that skip NaN would hide that half of
a dataset is unknown, and a line through two points is no law.
"""

from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase

import numpy as np
import xarray as xr

from .cutoff import once

FEWEST = 3
"""So many samples at least: any two of them make a line."""
SERIES = {
    "*": "tau piece_tau long_tau end output generation step half_width sites gamma frequency size "
    "initial start_amplitude a0 b0 distance decay sample point proof wave modulus",
    "checks/*": "mu",  # an order in mu takes three of them
}
"""The coordinates along which a claim is on many samples, by dataset."""

NO_NUMBER = {
    "checks/lyapunov": "exponents*",  # beyond the last exponent of a shorter chain
    "checks/ensembles*": "l2_* linf_*",  # at a half-width without an ensemble
    "checks/members": "rms",  # beyond the ends of a shorter chain
    "checks/trust": "*horizon known_until",  # without a reference
    "breathers/steady": "*",  # where a family has no state
    "breathers/periodic": "*",  # where a family has no breather, or nothing grows or collides
    "breathers/fates": "*frequency *distance *unreturned",  # of what does not stay
    "pendula/over_the_top": "passage_rate*",  # where nobody waited
    "pendula/phases": "larger_modulus",  # beyond the ends of a shorter chain
    "pendula/remainder": "error* order* largest_angle",  # beyond the end of a run
    "pendula/threshold": "gamma_0_finite",  # where no drive makes the chain unstable
    "unbounded/*": "bulk_maximum",  # of more neighbours than the bulk has
}
"""The variables in which NaN has a meaning; the functions that read these look at it themselves."""


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
        for what in _missing(name, datasets[name], on)
    )


@once
def _missing(name: str, dataset: xr.Dataset, on: tuple[str, ...]) -> list[str]:
    several = [along for along in ("case", "sweep") if along in dataset.indexes]
    read = {along: [one for one in dataset[along].values if one in on] for along in several}
    dataset = dataset.sel(read) if any(read.values()) else dataset
    spared = _words_on(name, NO_NUMBER)
    unknown = [
        f"{variable} is unknown in part"
        for variable, values in dataset.data_vars.items()
        if not any(fnmatchcase(str(variable), pattern) for pattern in spared)
        if values.dtype.kind in "fc" and np.isnan(values.values).any()
    ]
    few = [one for one in _words_on(name, SERIES) if dataset.sizes.get(one, FEWEST) < FEWEST]
    return [*unknown, *(f"{along} has fewer than {FEWEST} samples" for along in few)]


def _words_on(name: str, by_dataset: Mapping[str, str]) -> list[str]:
    return " ".join(w for like, w in by_dataset.items() if fnmatchcase(name, like)).split()
