"""Chaotic numbers, and their allowed errors in a correct run.

In the accepted results, one run of each case has only rounding errors. Its error is stored relative
to full scale as a function of time (`Trust`). The allowed error is this error divided by MARGIN.
The horizon of trust is the time at which the allowed error reaches TOLERANCE; a case without a
horizon is regular. After the horizon the allowed error grows, until any value is allowed.
"""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import read

from replication.variables import ALONG, ALWAYS, BY_CASE, CHAOS, NO, YES

from .hashes import are_words

TOLERANCE = 1e-6
"""Allowed error of a number relative to the largest; single precision alone causes 6e-8."""

ROUNDING = 1e-8
"""Smaller numbers may be rounding errors, whose digits are arbitrary."""

MARGIN = 0.001
"""Factor between the stored and the allowed error. Other solvers round at least ten times as often
as the run with only rounding errors, and rounding errors accumulate."""

LOCAL, UNKNOWN = 10.0, 0.1
"""Factor from the allowed error of a norm to the allowed error of a single site. Error relative to
full scale from which any value is allowed, because it no longer grows like a small error."""


class Trust(NamedTuple):
    """The variable with the errors of runs in the accepted results, and the names of dimensions.

    In `dataset`, `variable` (case, time) is the error of runs relative to full scale. `labels`
    select the run that has only rounding errors. `steps` are the dimensions along which the values
    of a run change gradually.
    """

    dataset: str
    variable: str
    labels: Mapping[str, str]
    time: str = "time"
    steps: tuple[str, ...] = ("time",)


class Chaos(NamedTuple):
    """The horizons of trust and the allowed errors of the accepted run."""

    horizons: Mapping[str, float]
    """The horizon of trust by chaotic case; -inf for a sweep over a chaotic case."""
    errors: Mapping[str, tuple[np.ndarray, np.ndarray]] = {}
    """Times and the allowed error up to each time, by chaotic case."""
    cases: Mapping[str, Mapping[str, Any]] = {}
    """The parameters by case of the configuration, empty for a sweep."""
    time: str = "time"

    def freedom(self, name: str, key: str, data: xr.Dataset) -> np.ndarray:
        """Return the allowed error of each value of the variable `key` of the dataset `name`.

        The error is relative to the largest value: 0 for a regular number, infinity if any value is
        allowed. It follows from the attribute `rests_on_chaos` (see `replication.variables`). A
        number belongs to a case or sweep if each word in the name of the case is in the name of the
        file or in a label of the number: the curve `large` in figures/fig3 belongs to fig3_large.
        """
        variable = data.variables[key]
        default = data.attrs.get(CHAOS, BY_CASE) if variable.dtype.kind == "f" else NO
        chaos = variable.attrs.get(CHAOS, default)
        if are_coordinates(key, variable, self.time) or chaos == NO:
            return np.zeros(variable.shape)
        if chaos.startswith(ALONG):
            return self._along(chaos.removeprefix(ALONG), variable, data)
        if chaos == YES:
            return np.full(variable.shape, np.inf)
        return self._of_cases(variable, data, name.removesuffix(".nc"), chaos == ALWAYS)

    def undeclared(self, name: str, data: xr.Dataset) -> list[str]:
        """Return the variables that are not declared chaotic or regular.

        They lack the attribute, and their dataset belongs to no case of the configuration.
        """
        dimensions = [_labels(dimension, data) for dimension in data.dims]
        labels = [words for along in dimensions for words in along]
        words = _words(name.removesuffix(".nc")).union(*labels)
        if any(_words(case) <= words for case in self.cases):
            return []
        return [
            str(key)
            for key, variable in data.variables.items()
            if variable.dtype.kind == "f" and not are_coordinates(str(key), variable, self.time)
            if CHAOS not in variable.attrs and CHAOS not in data.attrs
        ]

    def _along(self, parameter: str, variable: xr.Variable, data: xr.Dataset) -> np.ndarray:
        """Return 0 for each value of `parameter` at which all cases are regular, else infinity."""
        if parameter not in variable.dims:
            return np.full(variable.shape, np.inf)
        axis = [-1 if dimension == parameter else 1 for dimension in variable.dims]
        regular = np.isin(data[parameter].values, list(self._regular_values(parameter)))
        return np.broadcast_to(np.where(regular.reshape(axis), 0.0, np.inf), variable.shape)

    def _regular_values(self, parameter: str) -> set[float]:
        """Return the values of `parameter` that only regular cases have."""
        values: dict[bool, set[float]] = {True: set(), False: set()}
        for name, case in self.cases.items():
            if parameter in case:
                values[name in self.horizons].add(float(case[parameter]))
        return values[False] - values[True]

    def _of_cases(
        self, variable: xr.Variable, data: xr.Dataset, stem: str, at_all_times: bool
    ) -> np.ndarray:
        """Return the allowed errors of a variable whose values belong to cases or sweeps."""
        freedom = np.zeros(variable.shape)
        times = np.inf if at_all_times else _times(variable, data, self.time)
        labels = [_labels(dimension, data) for dimension in variable.dims]
        for place in np.ndindex(*map(len, labels)):
            pairs = list(zip(labels, place, strict=True))
            words = _words(stem).union(*(along[i] for along, i in pairs))
            cases = [case for case in self.horizons if _words(case) <= words]
            if cases:
                index = (slice(i, i + 1) if len(along) > 1 else slice(None) for along, i in pairs)
                freedom[tuple(index)] = np.max([self._until(case, times) for case in cases], axis=0)
        return freedom

    def _until(self, case: str, times: np.ndarray | float) -> np.ndarray:
        """Return the allowed errors of a case at these times."""
        tau, error = self.errors.get(case, (np.zeros(1), np.full(1, np.inf)))
        at = np.searchsorted(tau, times).clip(max=len(tau) - 1)
        return np.where(np.asarray(times) < self.horizons[case], 0.0, error[at])


def are_coordinates(key: str, variable: xr.Variable, time: str) -> bool:
    """Return whether a variable with the name `key` has the positions along a dimension."""
    return variable.dims in ((key,), (key.removesuffix(f"_{time}"),))


def cases_of(configuration: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """Return the parameters by case of a configuration, empty for a sweep."""
    return {
        **{sweep: {} for sweep in configuration.get("sweeps", {})},
        **configuration.get("cases", {}),
    }


def known_chaos(folder: Path, configuration: Mapping[str, Any], trust: Trust | None) -> Chaos:
    """Return the horizons and allowed errors of the baseline in `folder`.

    The configuration has the section `cases` with parameters by name, and the section `sweeps`, in
    which each sweep names its case.
    """
    cases, sweeps = cases_of(configuration), configuration.get("sweeps", {})
    if trust is None:
        return Chaos({}, cases=cases)
    horizons, errors = {}, {}
    for case, times, error in _growing_errors(folder, trust):
        if (late := error > TOLERANCE).any():
            horizons[case] = float(times[late.argmax()])
            errors[case] = times, np.where(error < UNKNOWN, LOCAL * error, np.inf)
    swept = {name: -np.inf for name, sweep in sweeps.items() if sweep["case"] in horizons}
    return Chaos(horizons | swept, errors, cases, trust.time)


def _growing_errors(folder: Path, trust: Trust) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """Yield each case with its times, and the largest allowed error up to each time."""
    data = read(folder / trust.dataset)
    difference = data[trust.variable].sel(trust.labels).transpose("case", trust.time)
    grown = np.maximum.accumulate(difference.fillna(0.0).values, axis=1) / MARGIN
    for case, error in zip(map(str, data["case"].values), grown, strict=True):
        yield case, data[trust.time].values, error


def _words(text: str) -> set[str]:
    return set(re.findall(r"[a-z0-9]+", text))


def _labels(dimension: str, data: xr.Dataset) -> list[set[str]]:
    """Return the words of each label along a dimension; one empty set if it has no labels."""
    along = data.variables.get(dimension)
    return [set()] if along is None or not are_words(along) else [*map(_words, along.values)]


def _times(variable: xr.Variable, data: xr.Dataset, time: str) -> np.ndarray | float:
    """Return the times of the values of a variable; infinity if it has no dimension of time."""
    for dimension in variable.dims:
        for name in (dimension, f"{dimension}_{time}"):
            if name.endswith(time) and name in data and data[name].dims == (dimension,):
                shape = [-1 if d == dimension else 1 for d in variable.dims]
                return data[name].values.reshape(shape)
    return np.inf
