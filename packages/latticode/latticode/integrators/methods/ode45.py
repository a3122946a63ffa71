"""MATLAB's ode45: the Dormand-Prince 5(4) pair under MATLAB's step control."""

from collections.abc import Callable, Mapping
from types import ModuleType
from typing import Any

from latticode.integrators.method import COARSEST, AdaptiveCost, Control, Method, Obstacle

from .dop853 import find_vanishing_square


class Ode45(Method):
    """Dormand and Prince's method of order five with the step control of MATLAB's ode45."""

    name, label, order = "ode45", "ode45", 5
    controls = {"rtol": Control(1e-7, at_least=1e-13, at_most=COARSEST), "atol": Control(1e-9)}
    cost = AdaptiveCost(0.18, 5, step_seconds=2e-7, pair_seconds=3.8e-8, pair_bytes=700)
    tightest = 1e-12
    look = ("#111111", "o")

    def find_obstacle(
        self, controls: Mapping[str, Any], peak: float, span: float, rate: float
    ) -> Obstacle | None:
        """Return a tolerance as an obstacle if it is zero or its square underflows, else None."""
        if float(controls["rtol"]) == 0.0:
            return "solver.rtol", "the relative tolerance of ode45 must be positive"
        return find_vanishing_square(controls)

    def kernels(self) -> ModuleType:
        """Return the compiled method."""
        from latticode.integrators import ode45

        return ode45


class Ode45Real(Ode45):
    """ode45 with real and imaginary parts as separate unknowns, each with its own error."""

    name, label = "ode45_real", "ode45 (real)"
    look = ("#8a8a8a", "P")

    def build(self, rule: Callable, observe: Callable, **more: Any) -> Callable:
        """Return the function `solve`, which measures the errors of real and imaginary parts."""
        return super().build(rule, observe, of_reals=True, **more)
