"""The solvers' controls: what may stand below `solver` and `solvers`, and the defaults."""

from typing import Annotated, Any, Literal

from pydantic import Field, SerializerFunctionWrapHandler, ValidationError, model_serializer

from .values import Model, Positive, Whole

FLAG = "by_default"
DEFAULT = {"name": "taylor", FLAG: True}
"""The solver of a case that names none."""
COARSEST = 0.1
"""Largest tolerance of a step's error: the estimate of that error holds for small errors only."""


class Ode45(Model):
    """Dormand and Prince's method of order five with the step control of MATLAB's ode45."""

    name: Literal["ode45"] = "ode45"
    rtol: Annotated[Positive, Field(ge=1e-13, le=COARSEST)] = 1e-7
    atol: Positive = 1e-9


class Dop853(Model):
    """The explicit Runge-Kutta method of order eight, for accuracy."""

    name: Literal["dop853"] = "dop853"
    rtol: Annotated[Positive, Field(ge=1e-15, le=COARSEST)] = 1e-13
    atol: Positive = 1e-13


class Taylor(Model):
    """The Taylor method, the default: at small errors the fastest."""

    name: Literal["taylor"] = "taylor"
    rtol: Annotated[Positive, Field(ge=1e-16, le=COARSEST)] = 1e-14
    atol: Positive = 1e-14
    by_default: bool = Field(False, repr=False)
    """Whether nobody named a solver, so that `dop853` takes over where there is no series."""

    @model_serializer(mode="wrap")
    def _named(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        values = write(self)
        return values if self.by_default else {k: one for k, one in values.items() if k != FLAG}


class Auto(Model):
    """Two families of methods, which must agree to an error of the fields, of full scale."""

    name: Literal["auto"] = "auto"
    error: Annotated[Positive, Field(ge=1e-13, lt=1)] = 1e-9


class Iterated(Model):
    """Controls of an implicit scheme that is solved by fixed-point iteration."""

    step: Positive = 0.0025
    tolerance: Annotated[Positive, Field(ge=1e-14, lt=1)] = 1e-13
    iterations: Annotated[Whole, Field(ge=2, le=1000)] = 50


class CrankNicolson(Iterated):
    """The trapezoidal rule."""

    name: Literal["crank_nicolson"] = "crank_nicolson"


class DelfourFortinPayre(Iterated):
    """The variant of Crank-Nicolson that conserves an energy; for models that declare it."""

    name: Literal["delfour_fortin_payre"] = "delfour_fortin_payre"


class KahanLi(Model):
    """Kahan and Li's symplectic composition of order eight, of second derivatives alone.

    Its step is the longest, in the time of the equations.
    """

    name: Literal["kahan_li"] = "kahan_li"
    step: Positive = 0.25


class Solvers(Model):
    """The controls of each solver where a case names it without giving its own."""

    ode45: Ode45 = Ode45()
    crank_nicolson: CrankNicolson = CrankNicolson()
    delfour_fortin_payre: DelfourFortinPayre = DelfourFortinPayre()
    dop853: Dop853 = Dop853()
    taylor: Taylor = Taylor()
    auto: Auto = Auto()
    kahan_li: KahanLi = KahanLi()


Solver = Annotated[
    Ode45 | CrankNicolson | DelfourFortinPayre | Dop853 | Taylor | Auto | KahanLi,
    Field(discriminator="name"),
]


def with_controls(item: Any, shared: Any) -> Any:
    """Return a case or sweep whose solver is a mapping, completed from the shared controls."""
    given = item.get("solver") if isinstance(item, dict) else None
    given = {"name": given} if isinstance(given, str) else given
    if not isinstance(given, dict) or not isinstance(shared, dict):
        return item
    name = given.get("name")
    controls = shared.get(name) if isinstance(name, str) else None
    controls = _sound(name, controls) if isinstance(controls, dict) else {}
    return {**item, "solver": {**controls, **given}}


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
