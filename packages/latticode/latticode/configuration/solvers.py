"""The controls of solvers: the allowed keys below `solver` and `solvers`, and their defaults.

Both follow from the methods in `latticode.integrators.methods`.
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
    """The controls of the default method, with a flag that is set if the user chose no solver.

    The flag lets `dop853` replace `taylor` if the solution has no power series.
    """

    @model_serializer(mode="wrap")
    def _without_flag(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        values = write(self)
        return (
            values if values.get(FLAG) else {k: value for k, value in values.items() if k != FLAG}
        )


class Auto(Section):
    """Two methods of different families, whose fields must agree within `error` of full scale."""

    name: Literal["auto"] = "auto"
    error: Annotated[Positive, Field(ge=1e-13, lt=1)] = 1e-9


def _field(control: Control) -> tuple[Any, Any]:
    kind = Integer if control.is_integer else Positive
    bounds = Field(ge=control.at_least, le=control.at_most, lt=control.below)
    return Annotated[kind, bounds], control.default


def model_of_controls(method: Method) -> type[Section]:
    """Return the pydantic model of a solver: the name of a method, and its controls."""
    kind, is_default = type(method), method.name == DEFAULT["name"]
    fields = {"name": (Literal[method.name], method.name)}
    fields |= {key: _field(control) for key, control in method.controls.items()}
    if is_default:
        fields[FLAG] = (bool, Field(False, repr=False))
    base = DefaultMethod if is_default else Section
    return create_model(kind.__name__, __base__=base, __doc__=kind.__doc__, **fields)


CONTROLS = {name: model_of_controls(method) for name, method in METHODS.items()} | {"auto": Auto}
"""The pydantic models of all solvers, by name."""
Taylor, Dop853 = CONTROLS["taylor"], CONTROLS["dop853"]
Solvers = create_model(
    "Solvers",
    __base__=Section,
    __doc__="The controls of each solver, for cases that set none themselves.",
    **{name: (controls, controls()) for name, controls in CONTROLS.items()},
)
Solver = Annotated[reduce(or_, CONTROLS.values()), Field(discriminator="name")]


def with_controls(item: Any, shared: Any) -> Any:
    """Return a case or sweep with its solver as a mapping, completed with the `shared` controls."""
    raw_solver = item.get("solver") if isinstance(item, dict) else None
    raw_solver = {"name": raw_solver} if isinstance(raw_solver, str) else raw_solver
    if not isinstance(raw_solver, dict) or not isinstance(shared, dict):
        return item
    name = raw_solver.get("name")
    controls = shared.get(name) if isinstance(name, str) else None
    controls = _valid_controls(name, controls) if isinstance(controls, dict) else {}
    return {**item, "solver": {**controls, **raw_solver}}


def _valid_controls(name: str, controls: dict) -> dict:
    """Return the shared controls without the invalid ones.

    These are reported once, under `solvers`, and not again by every case that uses the solver.
    """
    if name not in Solvers.model_fields:
        return controls
    try:
        Solvers.model_validate({name: controls})
    except ValidationError as error:
        faulty = {fault["loc"][1] for fault in error.errors() if len(fault["loc"]) > 1}
        return {key: value for key, value in controls.items() if key not in faulty}
    return controls
