"""Cases of a model of a user's own: `model: mine.py`, and parameters by the names of the model."""

import difflib
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Annotated, Any, Literal

from latticode.equations.ends import ENDS
from latticode.equations.model import Model as Traced
from latticode.equations.model import ModelError
from latticode.equations.model_file import at_middle, values_at
from latticode.simulation.feasibility import Obstacle, find_fault, rates_of
from pydantic import (
    BeforeValidator,
    Field,
    PlainSerializer,
    SerializationInfo,
    SerializeAsAny,
    WrapValidator,
    model_validator,
)

from .cases import Case, sites_of
from .files import OF_MODELS
from .solvers import OF_OWN_MODELS, OF_SECOND_ORDER
from .values import Complex, Number, Whole, fault, faults

OF_THE_PAPER = ("epsilon", "gamma", "omega", "mu")
"""Constants of the paper's equations, which mean nothing here."""


def is_own(value: Any) -> bool:
    """Return whether what stands at `model` is a model of a user's own."""
    named = isinstance(value, str) and value.endswith(OF_MODELS)
    return named or isinstance(value, Mapping | Traced)


def _as_model(value: Any) -> Traced:
    try:
        if isinstance(value, Mapping):
            raise fault(
                "is a mapping; give the path of a file, such as mine.py: a configuration"
                " holds no code"
            )
        return value if isinstance(value, Traced) else Traced.read(value)
    except ModelError as error:
        raise fault(str(error)) from None


def _as_written(model: Traced, info: SerializationInfo) -> Any:
    """Return a model as it is, or in JSON as its plain values."""
    return model.plain if info.mode == "json" else model


class OwnCase(Case):
    """An initial-value problem of traced equations: data and parameters as the model names them."""

    omega: Annotated[Number, Field(exclude=True)] = 0.0
    epsilon: Annotated[Number, Field(exclude=True)] = 0.0
    gamma: Annotated[Number, Field(exclude=True)] = 0.0
    mu: Annotated[None, Field(exclude=True)] = None
    initial: Annotated[
        dict[Whole, tuple[Complex, ...]],
        BeforeValidator(partial(sites_of, most=None)),
        Field(min_length=1),
    ]
    model: Annotated[Any, BeforeValidator(_as_model), PlainSerializer(_as_written, Any)]
    parameters: dict[str, Any] = {}
    boundary: Literal[tuple(ENDS)] = "dirichlet"

    @model_validator(mode="before")
    @classmethod
    def _without_constants(cls, raw: Any) -> Any:
        given = [key for key in OF_THE_PAPER if isinstance(raw, dict) and key in raw]
        if given:
            text = "belongs to the paper's equations; give the model's own below parameters"
            raise faults([(key, text) for key in given])
        return raw

    def _faults_of_model(self) -> Iterator[tuple[str, str]]:
        fields, known = self.model.fields, self.model.parameters
        for site, values in self.initial.items():
            if len(values) != len(fields):
                text = f"site {site} has {len(values)} values; give {len(fields)}"
                yield "initial", f"{text}, [{', '.join(fields)}]"
        if self.half_width < self.model.reach:
            text = f"is {self.half_width}; the equations look {self.model.reach} sites far"
            yield "half_width", text
        for name in self.parameters.keys() - known.keys():
            near = difflib.get_close_matches(name, known, 1)
            hint = f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known)}"
            yield f"parameters.{name}", f"is no parameter of {self.model.name}; {hint}"
        yield from self.faults_of_parameters(self.half_width)

    def faults_of_parameters(self, half_width: int) -> Iterator[tuple[str, str]]:
        """Yield the fault of each parameter that has no values on the sites of such a chain."""
        for name, value in self._given().items():
            try:
                values_at(value, half_width)
            except ValueError as error:
                where = "" if name in self.parameters else f" (the default in {self.model.name})"
                yield f"parameters.{name}", f"{error}{where}"

    def faults_of_half_widths(self, half_widths: list[int]) -> Iterator[tuple[str, str]]:
        """Yield the fault of each parameter without values on all chains of a sweep.

        All chains have the values of the longest at their sites, which must be those that a
        function gives for them.
        """
        longest, found = max(half_widths), []
        for name, text in self.faults_of_parameters(longest):
            found.append(name)
            yield name, f"on the longest chain: {text}"
        for name, value in self._given().items():
            if callable(value) and f"parameters.{name}" not in found:
                whole = values_at(value, longest)
                if any(at_middle(whole, m) != values_at(value, m) for m in half_widths):
                    text = "is a function with other values at the same sites of a longer chain"
                    yield f"parameters.{name}", f"{text}; let them follow from the site alone"

    def _given(self) -> dict[str, Any]:
        return {k: self.parameters.get(k, one) for k, one in self.model.parameters.items()}

    def _values(self, half_width: int) -> dict[str, float | list[float]]:
        return {name: values_at(value, half_width) for name, value in self._given().items()}

    def faults_of_solver(self, solver: Any) -> Iterator[tuple[str, str]]:
        """Yield the fault of a solver that does not take the equations of the case."""
        known = OF_OWN_MODELS + (OF_SECOND_ORDER if self.model.separable else ())
        if solver.name not in known:
            text = f"{solver.name} does not take models of one's own"
            yield "solver.name", f"{text}; give one of {', '.join(known)}"

    def _fault_and_rate(
        self, peak: float, span: float, solver: dict
    ) -> tuple[Obstacle | None, float]:
        values = self._values(self.half_width)
        found = find_fault({}, rates_of(self.model, values, peak), peak, span, solver)
        return found, self.model.rate(values, peak)

    def problem(self, **changes) -> dict:
        """Return the case as plain values of a Problem, some of them changed.

        Each parameter is what it is on the sites of the chain, so that a job depends on the values.
        """
        found = super().problem(**changes)
        values = self._values(found["half_width"])
        return {**found, "model": self.model.plain, "parameters": values}


def _of_its_kind(value: Any, handler) -> Case:
    own = isinstance(value, dict) and is_own(value.get("model"))
    return OwnCase.model_validate(value) if own else handler(value)


AnyCase = Annotated[SerializeAsAny[Case], WrapValidator(_of_its_kind)]
"""A case of the paper's equations, or of a model of a user's own."""
