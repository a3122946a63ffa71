"""Problems of the paper's equations: (4) of the amplitudes, and Newton's (1) of the pendula.

The plain values of a problem have the keys of a case in the configuration: omega, epsilon and
gamma, and for pendula also `model` and `mu`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from latticode.equations.ends import ANTIPERIODIC, kind_of
from latticode.equations.model import Model
from latticode.simulation import problem

from pendula.models.equations import (
    AMPLITUDE_MODEL,
    AMPLITUDES,
    MODEL_NAMED,
    MODELS,
    PENDULA,
    PENDULUM_MODEL,
    Constants,
)

if TYPE_CHECKING:
    from latticode.simulation.equations import Equations

BOUNDARIES = ("dirichlet", "free", "periodic")
"""The boundary conditions for which the paper's equations have an energy, bounds and proofs."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PaperProblem(problem.Problem):
    """An initial-value problem of the paper's equations, or of a user's own model.

    `model` may be a name, "amplitudes" or "pendula". Initial data and times are those of (4) for
    both: pendula start from the angles and velocities of (3) at A and B, and time is tau.

    Raises ValueError as its base class does, and for an unknown model or a missing or invalid mu.
    """

    model: Model | str = AMPLITUDES

    def __post_init__(self) -> None:
        if isinstance(self.model, str):
            object.__setattr__(self, "model", _model_of(self.model))
        super().__post_init__()
        if self.model.name in MODELS:
            self._require_mu()
            if kind_of(self.boundary) == ANTIPERIODIC:
                text = f"the paper's equations require a boundary of {', '.join(BOUNDARIES)}"
                raise ValueError(f"{text}, not {self.boundary}; or give a model of your own")

    def _require_mu(self) -> None:
        mu, omega = self.mu, self.constants.omega
        if self.model.name == PENDULA and not (mu is not None and 0.0 < mu < np.inf):
            raise ValueError(f"the pendula require a positive mu, not {mu}")
        if self.model.name == PENDULA and not 1.0 + mu * mu * omega > 0.0:
            raise ValueError(f"1 + mu^2 Omega must be positive: mu is {mu:g}, Omega {omega:g}")

    @classmethod
    def of(cls, values: Mapping) -> Self:
        """Return the problem that a mapping of plain values describes (see `plain`)."""
        if isinstance(values.get("model"), Mapping | Model):
            return super().of(values)
        plain_values = dict(values)
        model = _model_of(plain_values.pop("model", AMPLITUDES))
        parameters = {key: plain_values.pop(key) for key in model.parameters if key in plain_values}
        if "mu" in plain_values:
            raise ValueError("mu requires model: pendula")
        return super().of({**plain_values, "model": model, "parameters": parameters})

    def plain(self) -> dict[str, Any]:
        """Return the problem as plain values. For equations (4) they have no key `model`."""
        values = super().plain()
        if self.model.name in MODELS:
            values |= {"model": self.model.name} | values.pop("parameters")
            if self.model.name == AMPLITUDES:
                del values["model"]
        return values

    def changed(self, **changes: Any) -> Self:
        """Return the problem with some values changed; `constants` changes all three."""
        if "constants" in changes:
            changes["parameters"] = vars(changes.pop("constants"))
        if isinstance(changes.get("model"), str):
            changes["model"] = _model_of(changes["model"])
        return super().changed(**changes)

    @cached_property
    def equations(self) -> "Equations":
        """How the problem is integrated: (4) and (1) have own classes, other models are traced."""
        # here: kernels are slow to import, and the configuration does not need them
        from pendula.models.integrations import AmplitudeEquations, PendulumEquations

        if self.model is AMPLITUDE_MODEL:
            return AmplitudeEquations(self)
        return PendulumEquations(self) if self.model is PENDULUM_MODEL else super().equations

    @property
    def constants(self) -> Constants:
        """The constants of (4)."""
        return Constants.of(self.parameters)

    @property
    def mu(self) -> float | None:
        """The small parameter mu of pendula, or None for amplitudes."""
        return self.parameters.get("mu")


def _model_of(name: str) -> Model:
    if name not in MODEL_NAMED:
        raise ValueError(f"unknown model {name!r}; the models are {', '.join(MODEL_NAMED)}")
    return MODEL_NAMED[name]


def by_name(problems: Mapping[str, Mapping]) -> dict[str, PaperProblem]:
    """Return the problems that plain values describe, by name."""
    return {name: PaperProblem.of(values) for name, values in problems.items()}
