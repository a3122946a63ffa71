"""The section of a case of the paper's equations, with checks of its values.

Defaults are the values of the paper's cases, except for `solver` and `snapshot_step`.
"""

from collections.abc import Callable, Iterator, Mapping
from math import sqrt
from typing import Annotated, Any, ClassVar, Literal

from latticode.configuration import cases
from latticode.configuration.cases import Initial
from latticode.configuration.cost import RunCost
from latticode.configuration.files import OF_MODELS
from latticode.configuration.messages import lines_of
from latticode.configuration.schema import Configuration
from latticode.configuration.solvers import FLAG, Solver, Taylor
from latticode.configuration.values import Number, Positive, faults
from latticode.equations.initial_values import STORED_OBSERVABLES
from latticode.equations.model import Model
from latticode.simulation.feasibility import Obstacle
from pydantic import (
    Field,
    SerializeAsAny,
    ValidationError,
    WrapValidator,
    field_validator,
    model_validator,
)

from pendula.feasibility import find_fault, rate
from pendula.models.equations import AMPLITUDES, METHODS_OF, PENDULA, Constants
from pendula.problem import PaperProblem

from . import cost

CONSTANTS = ("omega", "epsilon", "gamma", "mu")


class PaperCaseSection(cases.CaseSection):
    """An initial-value problem of the paper's equations, and the solver that integrates it.

    The equations are (4) of the amplitudes, or with `model: pendula` Newton's equations (1). These
    need `mu`, and start from the angles and velocities of (3) at the initial amplitudes.
    """

    kind: ClassVar[type[PaperProblem]] = PaperProblem
    omega: Number
    epsilon: Number = 1.0
    gamma: Number = 1.0
    boundary: Literal["dirichlet", "free", "periodic"] = "dirichlet"
    initial: Initial = {0: (1, 0.1)}
    model: Literal["amplitudes", "pendula"] = AMPLITUDES
    mu: Positive | None = None
    keep: Literal[STORED_OBSERVABLES] = "moduli"
    parameters: Annotated[dict, Field(exclude=True, max_length=0)] = {}
    sites: Annotated[None, Field(exclude=True)] = None

    @model_validator(mode="before")
    @classmethod
    def _without_parameters(cls, raw: Any) -> Any:
        if isinstance(raw, dict) and "parameters" in raw:
            text = "only a model of your own has them; give omega, epsilon and gamma as keys"
            raise faults([("parameters", text)])
        if isinstance(raw, dict) and raw.get("sites") is not None:
            text = "is not allowed: the paper's chains have the sites -M..M; give half_width: M"
            raise faults([("sites", text)])
        return raw

    @field_validator("solver")
    @classmethod
    def _always_by_series(cls, solver: Solver) -> Solver:
        """Replace the default solver by `taylor`: these equations always have power series."""
        return Taylor(**solver.model_dump(exclude={FLAG})) if hasattr(solver, FLAG) else solver

    @property
    def equations(self) -> str:
        """The name of the equations, for messages."""
        return "Newton's equations" if self.model == PENDULA else "the amplitude equations"

    @property
    def fields(self) -> tuple[str, ...]:
        """The names of the amplitudes, which are also the initial data of the pendula."""
        return "A", "B"

    @classmethod
    def solvers_taking(cls, model: str) -> list[str]:
        """Return the solvers that can integrate the equations of this name."""
        return [*METHODS_OF[model], "auto"]

    @property
    def cheap_values(self) -> Mapping[str, Mapping]:
        """For each key that determines the cost, values at which a run is short."""
        return cost.CHEAP_VALUES if self.mu is None else cost.OF_PENDULA

    def _faults_of_model(self) -> Iterator[tuple[str, str]]:
        mu = self.mu
        if self.model == AMPLITUDES and mu is not None:
            yield "mu", "requires model: pendula; add it, or leave mu out"
        if self.model == PENDULA and self.start_time:
            yield "start_time", "pendula start at tau = 0, where (3) holds; leave start_time out"
        if self.model == PENDULA and mu is None:
            yield "mu", "is missing: Newton's equations require it; give for example 0.1"
        if self.model == PENDULA and mu is not None and not 1.0 + mu * mu * self.omega > 0.0:
            largest = 1.0 / sqrt(-self.omega)
            text = "the square of the pendula's frequency, 1 + mu^2 Omega, must be positive"
            yield "mu", f"{text}; with omega {self.omega:g}, give a mu below {largest:.4g}"

    def _values_by_name(self) -> dict[str, Any]:
        return {}  # the constants are keys of the case

    @property
    def varied(self) -> tuple[str, ...]:
        """The constants that an axis of a survey may change."""
        return CONSTANTS if self.model == PENDULA else CONSTANTS[:3]

    def _varied(self, name: str, value: Any) -> dict[str, Any]:
        return {name: value}

    def _fault_and_rate(
        self, peak: float, span: float, solver: dict
    ) -> tuple[Obstacle | None, float]:
        constants = Constants(epsilon=self.epsilon, gamma=self.gamma, omega=self.omega)
        obstacle = find_fault(constants, peak, span, solver, self.mu)
        return obstacle, rate(constants, peak, self.mu)

    def problem(self, **changes: Any) -> dict:
        """Return plain values of the case as a `PaperProblem` with `changes`, constants first."""
        plain_values = self._plain_values(**changes)
        values = {key: plain_values[key] for key in CONSTANTS if key in plain_values} | plain_values
        if values["model"] == AMPLITUDES:
            del values["model"], values["mu"]
        return values

    def cost(self, problem: Mapping) -> RunCost:
        """Return the cost of a problem of the case, given as plain values."""
        return cost.estimate(problem)

    def cost_with_checks(self, problem: Mapping) -> RunCost:
        """Return the cost of a run and its checks."""
        return cost.with_checks(problem)


def takes_model(value: Any) -> bool:
    """Return whether the value of `model` is a model or its file, not the paper's equations."""
    named = isinstance(value, str) and value.endswith(OF_MODELS)
    return named or isinstance(value, Mapping | Model)


def of_its_kind(raw: dict) -> type[cases.CaseSection]:
    """Return the class for the keys of a case: of the paper's equations, or of a user's model.

    Raises an error that lists the paper's constants if they are given together with a model.
    """
    if not takes_model(raw.get("model")):
        return PaperCaseSection
    text = "belongs to the paper's equations; put the model's constants under parameters"
    if constants := [(key, text) for key in CONSTANTS if key in raw]:
        raise faults(constants)
    return cases.CaseSection


def _validated(value: Any, handler: Callable) -> cases.CaseSection:
    kind = of_its_kind(value) if isinstance(value, dict) else PaperCaseSection
    if kind is PaperCaseSection:
        return handler(value)
    try:
        return kind.model_validate(value)
    except ValidationError as error:  # as text: a case of the paper does not have these keys
        lines = lines_of(error, Configuration, ("cases", "case"))
        raise faults([line.partition(": ")[::2] for line in lines]) from None


AnyCase = Annotated[SerializeAsAny[PaperCaseSection], WrapValidator(_validated)]
"""A case of the paper's equations, or of a traced model."""
