"""Cases of a model of a user's own: `model: mine.py`, and parameters by the names of the model."""

import difflib
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Annotated, Any

import numpy as np
from pydantic import (
    BeforeValidator,
    Field,
    PlainSerializer,
    SerializeAsAny,
    WrapValidator,
    model_validator,
)

from pendula.feasibility import Obstacle, find_fault_of_model
from pendula.model import Model as Traced
from pendula.model import ModelError

from .cases import Case, sites_of
from .files import OF_MODELS
from .solvers import OF_OWN_MODELS, OF_SECOND_ORDER
from .values import Complex, Number, Whole, fault, faults, shown

OF_THE_PAPER = ("epsilon", "gamma", "omega", "mu")
"""Constants of the paper's equations, which mean nothing here."""


def is_own(value: Any) -> bool:
    """Return whether what stands at `model` is a model of a user's own."""
    named = isinstance(value, str) and value.endswith(OF_MODELS)
    return named or isinstance(value, Mapping | Traced)


def _as_model(value: Any) -> Traced:
    try:
        if isinstance(value, Mapping):
            return Traced.of_text(str(value.get("name")), str(value.get("text")))
        return value if isinstance(value, Traced) else Traced.read(value)
    except ModelError as error:
        raise fault(str(error)) from None


def _as_parameter(value: Any) -> float | list[float]:
    several = isinstance(value, list | tuple | np.ndarray)
    try:
        found = [float(one) for one in (value if several else [value])]
    except (TypeError, ValueError):
        text = f"is {shown(value)}, not a number or a list of one for each site"
        raise fault(f"{text}; a function of the sites stands in the model's file") from None
    if not np.isfinite(found).all():
        raise fault(f"is {shown(value)}, which is not finite")
    return found if several else found[0]


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
    model: Annotated[
        Any, BeforeValidator(_as_model), PlainSerializer(lambda model: model.plain, dict | Any)
    ]
    parameters: dict[str, Annotated[float | list[float], BeforeValidator(_as_parameter)]] = {}

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
        for name, value in self.parameters.items():
            if name not in known:
                near = difflib.get_close_matches(name, known, 1)
                hint = f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known)}"
                yield f"parameters.{name}", f"is no parameter of {self.model.name}; {hint}"
            elif isinstance(value, list) and len(value) != 2 * self.half_width + 1:
                text = f"has {len(value)} values for {2 * self.half_width + 1} sites"
                yield f"parameters.{name}", text

    def faults_of_solver(self, solver: Any) -> Iterator[tuple[str, str]]:
        """Yield the fault of a solver that does not take the equations of the case."""
        known = OF_OWN_MODELS + (OF_SECOND_ORDER if self.model.second_order else ())
        if solver.name not in known:
            text = f"{solver.name} does not take models of one's own"
            yield "solver.name", f"{text}; give one of {', '.join(known)}"

    def _fault_and_rate(
        self, peak: float, span: float, solver: dict
    ) -> tuple[Obstacle | None, float]:
        found = find_fault_of_model(self.model, self.parameters, peak, span, solver)
        return found, self.model.rate(self.parameters, peak)

    def problem(self, **changes) -> dict:
        """Return the case as plain values of a Problem, some of them changed."""
        return {**super().problem(**changes), "model": self.model.plain}


def _of_its_kind(value: Any, handler) -> Case:
    own = isinstance(value, dict) and is_own(value.get("model"))
    return OwnCase.model_validate(value) if own else handler(value)


AnyCase = Annotated[SerializeAsAny[Case], WrapValidator(_of_its_kind)]
"""A case of the paper's equations, or of a model of a user's own."""
