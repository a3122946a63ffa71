"""An initial-value problem: model, parameters, chain, initial data, times and solver.

The configuration turns a case into a `Problem`, the simulation integrates the problem, and datasets
record it in their attributes. Jobs of a workflow receive the problem as a mapping of plain values,
which `Problem.plain` returns and `Problem.of` reads.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, Self

import numpy as np

from .couplings import at_middle
from .ends import ends_of
from .model import Model
from .model_file import chain_sites

STORED_OBSERVABLES = ("norms", "moduli", "state")
"""What datasets store of the snapshots: nothing, moduli in single precision, or these moduli and
the full state in double precision."""


@dataclass(frozen=True, kw_only=True, eq=False)
class InitialValueProblem:
    """An initial-value problem with its solver.

    parameters: values that replace the defaults of the model.
    initial: the fields at the start, complex (component, 2r + 1) on the sites -r..r; all other
        sites are at rest. With `site_count` the shape is (component, N).
    half_width: the number M for a chain with the sites -M..M; None for an infinite chain.
    site_count: the number N for a chain with the sites 0..N-1, instead of `half_width`.
    start_time, end_time, output_step: times in the unit of the equations.
    snapshot_every: number of outputs between two snapshots of all fields; 0 for none.
    snapshots_at: indices of outputs; if not empty, only these are snapshots.
    keep: one of STORED_OBSERVABLES.

    Raises ValueError for initial data outside the chain and for unknown names.
    """

    model: Model
    parameters: Mapping[str, Any] = field(default_factory=dict)
    half_width: int | None
    boundary: str
    initial: np.ndarray = field(repr=False)
    end_time: float
    output_step: float
    solver: Mapping[str, Any]  # {"name": ..., **controls}
    snapshot_every: int = 0
    start_time: float = 0.0
    snapshots_at: tuple[int, ...] = ()
    keep: str = "moduli"
    site_count: int | None = None

    def __post_init__(self) -> None:
        ends_of(self.boundary)
        initial, fields = np.array(self.initial, complex), self.model.fields
        expected = (
            "an odd number of sites" if self.site_count is None else f"{self.site_count} sites"
        )
        if initial.ndim != 2 or len(initial) != len(fields) or not self._fits(initial.shape[1]):
            text = f"initial has the shape {initial.shape}; give a row for each field"
            raise ValueError(f"{text} ({', '.join(fields)}) with {expected}")
        if self.half_width is not None and self.site_count is None:
            require_inside(initial.shape[1] // 2, self.half_width)
        if self.model.form == "dt":
            initial = initial.real + 0j
        initial.flags.writeable = False
        if self.keep not in STORED_OBSERVABLES:
            raise ValueError(f"keep is {self.keep!r}; give one of {', '.join(STORED_OBSERVABLES)}")
        object.__setattr__(self, "snapshots_at", tuple(self.snapshots_at))
        object.__setattr__(self, "initial", initial)
        object.__setattr__(self, "parameters", MappingProxyType(dict(self.parameters)))
        object.__setattr__(self, "solver", MappingProxyType(dict(self.solver)))

    def _fits(self, columns: int) -> bool:
        """Return whether initial data with this number of columns fit the chain."""
        return columns % 2 == 1 if self.site_count is None else columns == self.site_count

    @classmethod
    def of(cls, values: Mapping) -> Self:
        """Return the problem from the values that `plain` returned."""
        model = values["model"]
        model = model if isinstance(model, Model) else Model.of_plain(model)
        initial = on_sites(values["initial"], len(model.fields), values.get("site_count"))
        return cls(**{**values, "initial": initial, "model": model})

    def plain(self) -> dict[str, Any]:
        """Return plain values of the problem; data are {site: fields}, the model is a graph."""
        counted = {} if self.site_count is None else {"site_count": self.site_count}
        return {
            "half_width": self.half_width,
            **counted,
            "boundary": self.boundary,
            "initial": self.data_by_site,
            "end_time": self.end_time,
            "output_step": self.output_step,
            "solver": dict(self.solver),
            "snapshot_every": self.snapshot_every,
            "start_time": self.start_time,
            "snapshots_at": list(self.snapshots_at),
            "keep": self.keep,
            "model": self.model.plain,
            "parameters": dict(self.parameters),
        }

    def changed(self, **changes: Any) -> Self:
        """Return the problem with some values changed; parameters may be given by name.

        On a shorter chain, parameters keep their values on the middle sites.
        """
        values = {**self.parameters, **changes.pop("parameters", {})}
        # a model restored from its graph has no parameters
        known = changes.get("model", self.model).parameters or values
        values |= {name: changes.pop(name) for name in known if name in changes}
        values = {name: value for name, value in values.items() if name in known}
        half_width = changes.get("half_width")
        if half_width is not None:
            values = {name: at_middle(value, half_width) for name, value in values.items()}
        return replace(self, **changes, parameters=values)

    @cached_property
    def parameter_values(self) -> dict[str, Any]:
        """The value of each parameter: a number, an array (site,), or the entries of a matrix.

        Raises ValueError, naming the parameter, if a value does not fit the chain.
        """
        values = {}
        for name, entry in {**self.model.parameters, **self.parameters}.items():
            try:
                value = self.model.value_at(name, entry, self.site_numbers)
            except ValueError as error:
                raise ValueError(f"parameter {name} {error}") from None
            values[name] = np.array(value) if isinstance(value, list) else value
        return values

    @cached_property
    def site_dependent(self) -> frozenset[str]:
        """The names of the parameters that depend on the site."""
        return frozenset(name for name, value in self.parameter_values.items() if np.ndim(value))

    @property
    def site_numbers(self) -> range:
        """The sites of the chain: -M..M, or 0..N-1."""
        return chain_sites(self.half_width, self.site_count)

    @property
    def sites(self) -> int:
        """The number N of sites in the chain."""
        return len(self.site_numbers)

    @property
    def first_site_of_data(self) -> int:
        """The site of the first column of `initial`."""
        return 0 if self.site_count is not None else -(self.initial.shape[1] // 2)

    @property
    def data_by_site(self) -> dict[int, tuple[complex, ...]]:
        """The fields at the start as {site: (A, B)}, without the sites at rest."""
        return by_site(self.initial, self.first_site_of_data)

    @property
    def amplitudes(self) -> np.ndarray:
        """The fields at the start on the whole chain, complex (component, N)."""
        if self.site_count is not None:
            return self.initial
        return place(self.initial, self.half_width)

    @property
    def times(self) -> np.ndarray:
        """The output times from start_time to end_time in equal steps; whole numbers are exact."""
        return output_times(self.end_time, self.output_step, self.start_time)

    @property
    def span(self) -> float:
        """The duration of the run, in the time unit of the equations."""
        return self.end_time - self.start_time

    @property
    def snapshot_outputs(self) -> np.ndarray:
        """The indices of the outputs that are snapshots."""
        last = round(self.span / self.output_step)
        if self.snapshots_at:
            return np.array([number for number in self.snapshots_at if number <= last])
        return np.arange(0, last + 1, self.snapshot_every) if self.snapshot_every else np.arange(0)


def output_times(end_time: float, output_step: float, start_time: float = 0.0) -> np.ndarray:
    """Return the times from start_time to end_time in equal steps; whole numbers are exact.

    If `start_time` is a whole number of steps, the times equal those of a run that starts at 0.
    """
    count = round(end_time / output_step)
    first = round(start_time / output_step)
    if first and abs(first * output_step - start_time) > 1e-9 * abs(start_time):
        count, first = round((end_time - start_time) / output_step), 0
        return start_time + (end_time - start_time) * np.arange(count + 1) / count
    return end_time * np.arange(first, count + 1) / count


def place(initial: np.ndarray, half_width: int) -> np.ndarray:
    """Return amplitudes (field, 2M + 1): `initial` (field, 2r + 1) on -r..r, zero elsewhere."""
    reach = initial.shape[1] // 2
    require_inside(reach, half_width)
    amplitudes = np.zeros((len(initial), 2 * half_width + 1), complex)
    amplitudes[:, half_width - reach : half_width + reach + 1] = initial
    return amplitudes


def require_inside(site: int, half_width: int) -> None:
    """Raise ValueError if `site` lies beyond the end M of the chain."""
    if site > half_width:
        raise ValueError(f"site {site} lies outside the chain -{half_width}..{half_width}")


def on_sites(
    initial: Mapping[int, tuple[complex, ...]], fields: int = 2, site_count: int | None = None
) -> np.ndarray:
    """Return data {site: (A, B)} as amplitudes (field, 2r + 1) on the sites -r..r.

    With a `site_count` N the amplitudes are (field, N) on the sites 0..N-1.
    """
    sites = chain_sites(max(map(abs, initial), default=0), site_count)
    amplitudes = np.zeros((fields, len(sites)), complex)
    for site, pair in initial.items():
        amplitudes[:, sites.index(site)] = pair
    return amplitudes


def by_site(
    amplitudes: np.ndarray, first_site: int | None = None
) -> dict[int, tuple[complex, ...]]:
    """Return amplitudes (field, 2r + 1) as {site: (A, B)}, without the sites at rest.

    If all sites are at rest, the result contains only the central one. `first_site` is the site of
    the first column, by default -r.
    """
    reach = amplitudes.shape[1] // 2
    first = -reach if first_site is None else first_site
    moving = np.flatnonzero((amplitudes != 0).any(axis=0))
    columns = moving if moving.size else [reach]
    return {int(j) + first: tuple(map(complex, amplitudes[:, j])) for j in columns}


def write_initial(initial: Mapping[int, tuple[complex, complex]]) -> str:
    """Return initial data as JSON, in the form of the configuration: {"0": [1.0, 0.1]}."""
    return json.dumps({str(site): [_as_written(z) for z in pair] for site, pair in initial.items()})


def is_even(text: str) -> bool:
    """Return whether initial data, in the JSON of a dataset, are equal on the sites n and -n."""
    sites = read_initial(text)
    at_rest = (0.0, 0.0)
    return all(tuple(sites.get(-site, at_rest)) == tuple(pair) for site, pair in sites.items())


def read_initial(text: str) -> dict[int, tuple[complex, complex]]:
    """Return the initial data {site: (A, B)} in the JSON of `write_initial`."""
    return {int(site): tuple(complex(z) for z in pair) for site, pair in json.loads(text).items()}


def _as_written(z: complex) -> float | str:
    return z.real if z.imag == 0 else str(complex(z)).strip("()")


def name_window(window: tuple[float, float]) -> str:
    """Return the name of a time window in datasets, such as "[10, 50]"."""
    return f"[{window[0]:g}, {window[1]:g}]"
