"""One initial-value problem: model, constants, chain, data, times and solver.

The configuration makes a `Problem` of a case, the simulation integrates it, datasets describe it by
their attributes: there is no second form of it in the library. Workflow and scripts pass it on as
a mapping of plain values, since Snakemake compares such mappings from run to run: `Problem.plain`
writes one, `Problem.of` reads it.
"""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from latticode.equations.ends import ends_of
from latticode.equations.model import Model
from latticode.equations.model_file import at_middle

AMPLITUDES, PENDULA = MODELS = ("amplitudes", "pendula")
"""The amplitude equations (4), and Newton's equations (1) of the pendula."""


@dataclass(frozen=True, kw_only=True)
class Constants:
    """The constants of the equations (4), in the one order that they have everywhere.

    Keywords are required, so that no two of them can change places.
    """

    epsilon: float  # coupling of neighbours
    gamma: float  # strength of the drive
    omega: float  # detuning Omega

    def __iter__(self) -> Iterator[float]:
        """Yield epsilon, gamma and omega."""
        yield from (self.epsilon, self.gamma, self.omega)

    @classmethod
    def of(cls, values: Mapping) -> "Constants":
        """Return the constants that a mapping holds, such as the attributes of a dataset."""
        return cls(**{name: float(values[name]) for name in ("epsilon", "gamma", "omega")})

    def scaled(self, factor: float) -> "Constants":
        """Return all three times a factor, as another unit of time makes them."""
        return Constants(
            epsilon=factor * self.epsilon, gamma=factor * self.gamma, omega=factor * self.omega
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Problem:
    """One initial-value problem and how it is integrated.

    `model` names the equations: "amplitudes" are (4), "pendula" are (1). The second ones have one
    more constant, `mu`. Data and times are those of (4) for either: pendula start from the angles
    and velocities that (3) makes of A and B. Time is the slow time tau. A traced model in place of
    a name has `parameters` and no `constants`; time and data are its own. `initial` is complex, of
    shape (component, 2r + 1): A and B on the sites -r..r at tau = 0; all sites beyond are at rest.
    `half_width` is M, the chain has the sites -M..M; None stands for an infinite chain.
    `snapshot_every` keeps the size of each component at every site at each so many outputs; 0 keeps
    none.

    Raises ValueError where data lie outside the chain, where there is no such model or there are no
    such ends, and where mu is missing or means nothing.
    """

    constants: Constants | None
    half_width: int | None
    boundary: str
    initial: np.ndarray = field(repr=False)
    end_time: float
    output_step: float
    solver: Mapping[str, Any]  # {"name": ..., **controls}
    snapshot_every: int = 0
    model: str | Model = AMPLITUDES
    parameters: Mapping[str, Any] = field(default_factory=dict)  # of a traced model
    mu: float | None = None  # of the pendula: the size of their angles

    def __post_init__(self):
        if not self.is_own:
            require_model(self.model, self.mu, self.constants.omega)
        ends_of(self.boundary)
        initial = np.array(self.initial, complex)
        fields = self.model.fields if self.is_own else ("A", "B")
        if initial.ndim != 2 or len(initial) != len(fields) or initial.shape[1] % 2 == 0:
            what = " and ".join(fields)
            raise ValueError(f"data of {what} on an odd number of sites, not {initial.shape}")
        if self.half_width is not None:
            require_inside(initial.shape[1] // 2, self.half_width)
        initial.flags.writeable = False
        object.__setattr__(self, "initial", initial)
        object.__setattr__(self, "solver", MappingProxyType(dict(self.solver)))

    @classmethod
    def of(cls, values: Mapping) -> "Problem":
        """Return the problem that a mapping of plain values describes (see `plain`)."""
        rest = {key: value for key, value in values.items() if key not in Constants.__annotations__}
        initial = on_sites(rest.pop("initial"))
        if isinstance(model := rest.get("model"), Mapping | Model):
            model = model if isinstance(model, Model) else Model.of_plain(model)
            return cls(**{**rest, "constants": None, "initial": initial, "model": model})
        return cls(constants=Constants.of(values), initial=initial, **rest)

    @property
    def is_own(self) -> bool:
        """Whether the equations are a traced model."""
        return isinstance(self.model, Model)

    def plain(self) -> dict[str, Any]:
        """Return the problem as plain values; `initial` is {site: (A, B)}, zero beyond.

        Problems of (4) name no model, as it was when there was no other. That of a traced model is
        its graph, so that no job runs its code again.
        """
        if self.is_own:
            equations = {"model": self.model.plain, "parameters": dict(self.parameters)}
        else:
            other = {"model": self.model, "mu": self.mu} if self.model != AMPLITUDES else {}
            equations = vars(self.constants) | other
        return {
            "half_width": self.half_width,
            "boundary": self.boundary,
            "initial": by_site(self.initial),
            "end_time": self.end_time,
            "output_step": self.output_step,
            "solver": dict(self.solver),
            "snapshot_every": self.snapshot_every,
            **equations,
        }

    def changed(self, **changes) -> "Problem":
        """Return the problem with other values; those of `constants` may be given by name.

        On a shorter chain, parameters have the values of the sites in its middle.
        """
        named = {name: changes.pop(name) for name in Constants.__annotations__ if name in changes}
        if named:
            changes["constants"] = replace(changes.get("constants", self.constants), **named)
        if self.parameters and "half_width" in changes:
            values = changes.get("parameters", self.parameters).items()
            changes["parameters"] = {k: at_middle(one, changes["half_width"]) for k, one in values}
        return replace(self, **changes)

    @property
    def sites(self) -> int:
        """The number N = 2M + 1 of pairs in the chain."""
        return 2 * self.half_width + 1

    @property
    def amplitudes(self) -> np.ndarray:
        """The fields on the whole chain at tau = 0, complex of shape (component, N)."""
        return place(self.initial, self.half_width)

    @property
    def times(self) -> np.ndarray:
        """The output times 0, ..., end_time in equal steps; integers among them are exact."""
        return output_times(self.end_time, self.output_step)


def require_model(model: str, mu: float | None, omega: float) -> None:
    """Raise ValueError if there is no such model, or if mu does not fit it."""
    if model not in MODELS:
        raise ValueError(f"there is no model {model!r}; there are {', '.join(MODELS)}")
    if model == AMPLITUDES and mu is not None:
        raise ValueError("mu has a meaning for the pendula only")
    if model == PENDULA and not (mu is not None and 0.0 < mu < np.inf):
        raise ValueError(f"the pendula need a positive mu, not {mu}")
    if model == PENDULA and not 1.0 + mu * mu * omega > 0.0:
        raise ValueError(f"1 + mu^2 Omega must be positive: mu is {mu:g}, Omega {omega:g}")


def by_name(problems: Mapping[str, Mapping]) -> dict[str, Problem]:
    """Return the problems that mappings of plain values describe, under their names."""
    return {name: Problem.of(values) for name, values in problems.items()}


def output_times(end_time: float, output_step: float) -> np.ndarray:
    """Return 0, ..., end_time in equal steps; integers among them are exact."""
    count = round(end_time / output_step)
    return end_time * np.arange(count + 1) / count


def place(initial: np.ndarray, half_width: int) -> np.ndarray:
    """Return amplitudes (., 2M + 1): `initial` (., 2r + 1) on the sites -r..r, zero elsewhere."""
    reach = initial.shape[1] // 2
    require_inside(reach, half_width)
    amplitudes = np.zeros((len(initial), 2 * half_width + 1), complex)
    amplitudes[:, half_width - reach : half_width + reach + 1] = initial
    return amplitudes


def require_inside(site: int, half_width: int) -> None:
    """Raise ValueError if the chain has no such site."""
    if site > half_width:
        raise ValueError(f"site {site} lies outside the chain -{half_width}..{half_width}")


def on_sites(initial: Mapping[int, tuple[complex, complex]]) -> np.ndarray:
    """Return data {site: (A, B)} as an array of (2, 2r + 1) amplitudes on the sites -r..r."""
    reach = max(map(abs, initial), default=0)
    fields = max(map(len, initial.values()), default=2)
    amplitudes = np.zeros((fields, 2 * reach + 1), complex)
    for site, pair in initial.items():
        amplitudes[:, reach + site] = pair
    return amplitudes


def by_site(amplitudes: np.ndarray) -> dict[int, tuple[complex, complex]]:
    """Return amplitudes (2, 2r + 1) as {site: (A, B)}, the sites at rest left out.

    Where all are at rest the central site stands for them.
    """
    reach = amplitudes.shape[1] // 2
    moving = np.flatnonzero((amplitudes != 0).any(axis=0))
    columns = moving if moving.size else [reach]
    return {int(j) - reach: tuple(map(complex, amplitudes[:, j])) for j in columns}


def write_initial(initial: Mapping[int, tuple[complex, complex]]) -> str:
    """Return initial data as the configuration writes them: {"0": [1.0, 0.1]}."""
    return json.dumps({str(site): [_as_written(z) for z in pair] for site, pair in initial.items()})


def is_even(text: str) -> bool:
    """Return whether data, as datasets keep them, are the same on sites n and -n."""
    sites = read_initial(text)
    rest = (0.0, 0.0)
    return all(tuple(sites.get(-site, rest)) == tuple(pair) for site, pair in sites.items())


def read_initial(text: str) -> dict[int, tuple[complex, complex]]:
    """Return the initial data that `write_initial` has written."""
    return {int(site): tuple(complex(z) for z in pair) for site, pair in json.loads(text).items()}


def _as_written(z: complex) -> float | str:
    return z.real if z.imag == 0 else str(complex(z)).strip("()")


def name_window(window: tuple[float, float]) -> str:
    """Return a time window as the datasets name it: "[10, 50]"."""
    return f"[{window[0]:g}, {window[1]:g}]"
