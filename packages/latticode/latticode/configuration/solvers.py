"""The solvers' controls: what may stand below `solver` and `solvers`, and the defaults.

They follow from the methods of the library; see `latticode.integrators.method`.
"""

from functools import reduce
from operator import or_
from typing import Annotated, Any, Literal

from pydantic import (
    Field,
    SerializerFunctionWrapHandler,
    ValidationError,
    create_model,
    model_serializer,
)

from latticode.integrators.method import Control, Method
from latticode.integrators.methods import METHODS

from .values import Integer, Positive, Section

FLAG = "by_default"
DEFAULT = {"name": "taylor", FLAG: True}
"""The solver of a case that names none."""


class DefaultMethod(Section):
    """The controls of the default method, with a flag where nobody named a solver.

    The flag lets `dop853` take over where there is no power series.
    """

    @model_serializer(mode="wrap")
    def _without_flag(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        values = write(self)
        return (
            values if values.get(FLAG) else {k: value for k, value in values.items() if k != FLAG}
        )


class Auto(Section):
    """Two families of methods, which must agree to an error of the fields, of full scale."""

    name: Literal["auto"] = "auto"
    error: Annotated[Positive, Field(ge=1e-13, lt=1)] = 1e-9


def _field(control: Control) -> tuple[Any, Any]:
    kind = Integer if control.is_integer else Positive
    bounds = Field(ge=control.at_least, le=control.at_most, lt=control.below)
    return Annotated[kind, bounds], control.default


def model_of_controls(method: Method) -> type[Section]:
    """Return the model of a mapping with the name of a method and its controls."""
    kind, is_default = type(method), method.name == DEFAULT["name"]
    fields = {"name": (Literal[method.name], method.name)}
    fields |= {key: _field(control) for key, control in method.controls.items()}
    if is_default:
        fields[FLAG] = (bool, Field(False, repr=False))
    base = DefaultMethod if is_default else Section
    return create_model(kind.__name__, __base__=base, __doc__=kind.__doc__, **fields)


CONTROLS = {name: model_of_controls(method) for name, method in METHODS.items()} | {"auto": Auto}
"""The models of all solvers by name."""
Taylor, Dop853 = CONTROLS["taylor"], CONTROLS["dop853"]
Solvers = create_model(
    "Solvers",
    __base__=Section,
    __doc__="The controls of each solver where a case names it without giving its own.",
    **{name: (controls, controls()) for name, controls in CONTROLS.items()},
)
Solver = Annotated[reduce(or_, CONTROLS.values()), Field(discriminator="name")]


def with_controls(item: Any, shared: Any) -> Any:
    """Return a case or sweep whose solver is a mapping, completed from the shared controls."""
    raw_solver = item.get("solver") if isinstance(item, dict) else None
    raw_solver = {"name": raw_solver} if isinstance(raw_solver, str) else raw_solver
    if not isinstance(raw_solver, dict) or not isinstance(shared, dict):
        return item
    name = raw_solver.get("name")
    controls = shared.get(name) if isinstance(name, str) else None
    controls = _sound(name, controls) if isinstance(controls, dict) else {}
    return {**item, "solver": {**controls, **raw_solver}}


def _sound(name: str, controls: dict) -> dict:
    """Return the shared controls without their faults, which are told where they stand alone.

    Each case that uses the solver would repeat them.
    """
    if name not in Solvers.model_fields:
        return controls
    try:
        Solvers.model_validate({name: controls})
    except ValidationError as error:
        faulty = {fault["loc"][1] for fault in error.errors() if len(fault["loc"]) > 1}
        return {key: value for key, value in controls.items() if key not in faulty}
    return controls
