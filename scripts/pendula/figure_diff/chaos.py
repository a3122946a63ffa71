"""Which numbers rest on chaos, so that two right runs may differ in them by any amount.

One definition of the horizon of trust, from the accepted run: the time at which the run by Taylor's
method, whose only errors are roundings, leaves the reference by MARGIN of the tolerance. Until then
those of any right run are smaller than the tolerance. A case without such a time is regular.
"""

import re
from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import read

from .hashes import are_words

TOLERANCE = 1e-6
"""How far a number may be off, as a part of the largest: single precision alone gives 6e-8."""

ROUNDING = 1e-8
"""A variable with nothing larger holds errors of rounding, of which no digit can be compared."""

MARGIN = 0.001
"""Other solvers round ten times as often as Taylor's, or more, and roundings add up."""

TRUST, ROUNDED_ONLY = "checks/trust.nc", "taylor"
"""The dataset with the differences to the references, and the solver among those of it."""


RESTS_ON_CHAOS = [
    # Maps and scans over data, some of which lead to chaos
    *("breathers/fates:*fate", "breathers/sensitivity:*"),
    *("checks/lifetimes:*", "figures/lifetimes:*", "figures/fates:*fate"),
    # Chains without ends, at the detuning of a chaotic case
    *("figures/fronts:*", "unbounded/fronts:*", "unbounded/omegas:*"),
]
"""Variables, by dataset, that rest on chaos although no chaotic case or sweep stands in the name of
the file or along a dimension."""

DIVIDED_BY_THE_TAIL = ["checks/*:difference", "figures/*:largest_so_far"]
"""Variables that are divided by the largest value of a run: of a chaotic one, it is in the tail."""

STEADY = [
    *("*omega", "*:start", "*_start", "*:true_*", "*_undriven", "*:stated_drift"),
    *("*:theorem_*", "*:widened", "*:l*_bound"),
    "checks/trust:*distance",
    *("*:linear_speed", "*:predicted_[dr]*", "*:predicted_speed", "*:thermal*_power"),
    "pendula/remainder:error",  # it ends before chaos
]
"""Variables that theory, a reference or the configuration gives, also those beside chaotic runs."""


class Chaos(NamedTuple):
    """What is known of chaos in the accepted run."""

    horizons: Mapping[str, float]
    """The horizon of trust of each chaotic case, and -inf for each sweep over one, by name."""

    def beyond(self, name: str, key: str, data: xr.Dataset) -> np.ndarray:
        """Return which values of the variable `key` of the dataset `name` cannot be judged.

        A case or a sweep is known by the parts of its name in the name of the file and in the words
        along the dimensions: the curve `large` in figures/fig3 is of fig3_large.
        """
        variable, stem = data.variables[key], name.removesuffix(".nc")
        label, found = f"{stem}:{key}", np.zeros(variable.shape, bool)
        if are_coordinates(key, variable):  # a star does not mean them
            return found | (label in RESTS_ON_CHAOS)
        if _is_one_of(label, STEADY):
            return found
        if _is_one_of(label, RESTS_ON_CHAOS):
            return ~found
        if variable.dtype.kind != "f":  # counts and parameters
            return found
        has_horizon = not _is_one_of(label, DIVIDED_BY_THE_TAIL)
        times = _times(variable, data) if has_horizon else np.inf
        labels = [_labels(dimension, data) for dimension in variable.dims]
        for place in np.ndindex(*map(len, labels)):
            pairs = list(zip(labels, place, strict=True))
            words = _parts(stem).union(*(along[i] for along, i in pairs))
            hits = [at for known, at in self.horizons.items() if _parts(known) <= words]
            if hits:
                index = (slice(i, i + 1) if len(along) > 1 else slice(None) for along, i in pairs)
                found[tuple(index)] = times >= min(hits)
        return found


def _is_one_of(label: str, patterns: Iterable[str]) -> bool:
    return any(fnmatchcase(label, pattern) for pattern in patterns)


def are_coordinates(key: str, variable: xr.Variable) -> bool:
    """Return whether a variable of this name says where the values along a dimension lie."""
    return variable.dims in ((key,), (key.removesuffix("_tau"),))


def horizons(folder: Path, sweeps: Mapping[str, Any]) -> dict[str, float]:
    """Return the horizons that the baseline in `folder`, which has these sweeps, tells."""
    trust = read(folder / TRUST)
    apart = trust["difference"].sel(solver=ROUNDED_ONLY) > MARGIN * TOLERANCE
    first = trust["tau"].values[apart.argmax("tau").values]
    pairs = zip(trust["case"].values, first, apart.any("tau").values, strict=True)
    found = {str(case): float(tau) for case, tau, is_chaotic in pairs if is_chaotic}
    return found | {name: -np.inf for name, sweep in sweeps.items() if sweep["case"] in found}


def _parts(text: str) -> set[str]:
    return set(re.findall(r"[a-z0-9]+", text))


def _labels(dimension: str, data: xr.Dataset) -> list[set[str]]:
    """Return the words at each place along a dimension; one empty set for one without words."""
    along = data.variables.get(dimension)
    return [set()] if along is None or not are_words(along) else [*map(_parts, along.values)]


def _times(variable: xr.Variable, data: xr.Dataset) -> np.ndarray | float:
    """Return the times along the dimensions of a variable; infinity for one without a time."""
    for dimension in variable.dims:
        for name in (dimension, f"{dimension}_tau"):
            if name.endswith("tau") and name in data and data[name].dims == (dimension,):
                shape = [-1 if d == dimension else 1 for d in variable.dims]
                return data[name].values.reshape(shape)
    return np.inf
