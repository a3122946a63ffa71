"""Which numbers rest on chaos, and how far they may be off in a right run.

The accepted run says it: the run by Taylor's method, whose only errors are roundings, leaves the
reference by `difference` of full scale. Those of any right run are smaller than that over MARGIN.
The horizon of trust is the time at which this reaches the tolerance; a case without one is regular.
From then on a number is the less known the later it is, until nothing of it is.
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

LOCAL, UNKNOWN = 10.0, 0.1
"""How much more than a norm the numbers of single sites may be off after the horizon; and what part
of full scale an error has that no longer grows as a small one does, so that it may be any."""

TRUST, ROUNDED_ONLY = "checks/trust.nc", "taylor"
"""The dataset with the differences to the references, and the solver among those of it."""


RESTS_ON_CHAOS = [
    # Maps and scans over data, some of which lead to chaos
    *("breathers/fates:*fate", "breathers/sensitivity:*"),
    *("checks/lifetimes:*", "figures/lifetimes:*", "figures/fates:*fate"),
    "checks/second_solver:*l2",
    # Chains without ends, at the detuning of a chaotic case
    *("figures/fronts:*", "unbounded/fronts:*", "unbounded/omegas:*", "unbounded/starts:*"),
    # Ensembles of pendula at a chaotic detuning, and the amplitude equations beside them
    *("pendula/over_the_top:*", "figures/pendula_over_the_top:*"),
]
"""Variables, by dataset, that rest on chaos although no chaotic case or sweep stands in the name of
the file or along a dimension."""

OF_THE_TAIL = ["checks/*:difference", "figures/*:largest_so_far", "figures/growth_law:law"]
"""Variables that rest on the tail of a run at all times: they are divided by its largest value, or
are a law whose speeds are measured on it."""

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
    errors: Mapping[str, tuple[np.ndarray, np.ndarray]] = {}
    """By the name of a chaotic case, times, and what a right run may be off until each of them."""
    regular_omegas: frozenset[float] = frozenset()
    """The detunings at which no case is chaotic."""

    def freedom(self, name: str, key: str, data: xr.Dataset) -> np.ndarray:
        """Return how far each value of the variable `key` of the dataset `name` may be off.

        This is a part of the largest: zero for a regular number, infinity where nothing is known.
        A case or a sweep is known by the parts of its name in the name of the file and in the words
        along the dimensions: the curve `large` in figures/fig3 is of fig3_large.
        """
        variable, stem = data.variables[key], name.removesuffix(".nc")
        label, nothing = f"{stem}:{key}", np.zeros(variable.shape)
        if are_coordinates(key, variable):  # a star does not mean them
            return np.full(variable.shape, np.inf if label in RESTS_ON_CHAOS else 0.0)
        if _is_one_of(label, STEADY):
            return nothing
        if _is_one_of(label, RESTS_ON_CHAOS):
            return np.where(self._at_regular_omegas(variable, data), nothing, np.inf)
        if variable.dtype.kind != "f":  # counts and parameters
            return nothing
        return self._of_cases(variable, data, stem, _is_one_of(label, OF_THE_TAIL))

    def _at_regular_omegas(self, variable: xr.Variable, data: xr.Dataset) -> np.ndarray:
        """Return which values stand at a detuning at which no case of the paper is chaotic."""
        if "omega" not in variable.dims:
            return np.array(False)
        axis = [-1 if dimension == "omega" else 1 for dimension in variable.dims]
        return np.isin(data["omega"].values, list(self.regular_omegas)).reshape(axis)

    def _of_cases(
        self, variable: xr.Variable, data: xr.Dataset, stem: str, of_the_tail: bool
    ) -> np.ndarray:
        """Return the freedom of values, of which some are of chaotic cases or sweeps."""
        freedom = np.zeros(variable.shape)
        times = np.inf if of_the_tail else _times(variable, data)
        labels = [_labels(dimension, data) for dimension in variable.dims]
        for place in np.ndindex(*map(len, labels)):
            pairs = list(zip(labels, place, strict=True))
            words = _parts(stem).union(*(along[i] for along, i in pairs))
            cases = [known for known in self.horizons if _parts(known) <= words]
            if cases:
                index = (slice(i, i + 1) if len(along) > 1 else slice(None) for along, i in pairs)
                freedom[tuple(index)] = np.max([self._until(case, times) for case in cases], axis=0)
        return freedom

    def _until(self, case: str, times: np.ndarray | float) -> np.ndarray:
        """Return how far the numbers of a case may be off at these times."""
        tau, error = self.errors.get(case, (np.zeros(1), np.full(1, np.inf)))
        at = np.searchsorted(tau, times).clip(max=len(tau) - 1)
        return np.where(np.asarray(times) < self.horizons[case], 0.0, error[at])


def _is_one_of(label: str, patterns: Iterable[str]) -> bool:
    return any(fnmatchcase(label, pattern) for pattern in patterns)


def are_coordinates(key: str, variable: xr.Variable) -> bool:
    """Return whether a variable of this name says where the values along a dimension lie."""
    return variable.dims in ((key,), (key.removesuffix("_tau"),))


def known_chaos(folder: Path, configuration: Mapping[str, Any]) -> Chaos:
    """Return what the baseline in `folder`, of this configuration, tells of chaos."""
    trust = read(folder / TRUST)
    difference = trust["difference"].sel(solver=ROUNDED_ONLY).transpose("case", "tau")
    grown = np.maximum.accumulate(difference.fillna(0.0).values, axis=1) / MARGIN
    tau, horizons, errors = trust["tau"].values, {}, {}
    for case, error in zip(map(str, trust["case"].values), grown, strict=True):
        if (late := error > TOLERANCE).any():
            horizons[case] = float(tau[late.argmax()])
            errors[case] = tau, np.where(error < UNKNOWN, LOCAL * error, np.inf)
    sweeps, cases = (configuration.get(name, {}) for name in ("sweeps", "cases"))
    swept = {name: -np.inf for name, sweep in sweeps.items() if sweep["case"] in horizons}
    omegas = [
        {float(cases[name]["omega"]) for name in cases if (name in horizons) == chaotic}
        for chaotic in (False, True)
    ]
    return Chaos(horizons | swept, errors, frozenset(omegas[0] - omegas[1]))


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
