"""Values of the configuration (numbers, names) and the controls of each solver."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

Complex = Annotated[complex, BeforeValidator(lambda value: _as_complex(value))]
Number = Annotated[
    float, BeforeValidator(lambda value: _no_bool(value)), Field(allow_inf_nan=False)
]
Positive = Annotated[Number, Field(gt=0)]
Whole = Annotated[int, BeforeValidator(lambda value: _no_bool(value))]
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$")]


def _no_bool(value: Any) -> Any:
    if isinstance(value, bool):
        raise PydanticCustomError("number", "is {value}, not a number", {"value": str(value)})
    return value


def _as_complex(value: Any) -> complex:
    """Read 2, 2.0 or "-0.3+0.4j" as Python writes complex numbers; refuse what is not finite."""
    try:
        number = complex(value.replace(" ", "") if isinstance(value, str) else _no_bool(value))
    except (TypeError, ValueError):
        raise PydanticCustomError(
            "complex",
            'is {value}, not a complex number such as "-0.3+0.4j"',
            {"value": repr(value)},
        ) from None
    if not abs(number) < float("inf"):
        raise PydanticCustomError("finite", "is {value}, which is not finite", {"value": value})
    return number


class Model(BaseModel):
    """A mapping of the configuration: unknown keys are faults."""

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True)


class Ode45(Model):
    """MATLAB's ode45, at the paper's tolerances."""

    name: Literal["ode45"] = "ode45"
    rtol: Annotated[Positive, Field(ge=1e-13, lt=1)] = 1e-7
    atol: Positive = 1e-9


class Dop853(Model):
    """The explicit Runge-Kutta method of order eight, for accuracy."""

    name: Literal["dop853"] = "dop853"
    rtol: Annotated[Positive, Field(ge=1e-15, lt=1)] = 1e-13
    atol: Positive = 1e-13


class Taylor(Model):
    """The Taylor method: the fastest at every error that was measured, and the default."""

    name: Literal["taylor"] = "taylor"
    rtol: Annotated[Positive, Field(ge=1e-16, lt=1)] = 1e-14
    atol: Positive = 1e-14


class Auto(Model):
    """The default solver, held to an error of the norms relative to their largest values."""

    name: Literal["auto"] = "auto"
    error: Annotated[Positive, Field(ge=1e-13, lt=1)] = 1e-9


class CrankNicolson(Model):
    """The energy-conserving Crank-Nicolson scheme with fixed-point iteration."""

    name: Literal["crank_nicolson"] = "crank_nicolson"
    step: Positive = 0.0025
    tolerance: Annotated[Positive, Field(ge=1e-14, lt=1)] = 1e-13
    iterations: Annotated[Whole, Field(ge=2, le=1000)] = 50


class Solvers(Model):
    """The controls of each solver where a case names it without giving its own."""

    ode45: Ode45 = Ode45()
    crank_nicolson: CrankNicolson = CrankNicolson()
    dop853: Dop853 = Dop853()
    taylor: Taylor = Taylor()
    auto: Auto = Auto()


Solver = Annotated[Ode45 | CrankNicolson | Dop853 | Taylor | Auto, Field(discriminator="name")]
