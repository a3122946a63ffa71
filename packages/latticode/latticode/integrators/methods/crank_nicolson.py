"""Crank-Nicolson, the paper's second solver, for traced models, and its conserving variant."""

from collections.abc import Callable, Mapping
from types import ModuleType
from typing import Any, NamedTuple

from latticode.equations.model import Model
from latticode.integrators.method import Control, Demand, Method


class IteratedCost(NamedTuple):
    """Steps of an implicit scheme, each solved by fixed-point iteration."""

    step_seconds: float = 7e-8
    pair_seconds: float = 3.5e-9
    evaluation_seconds: float = 7e-8
    evaluation_pair_seconds: float = 5.5e-9
    pair_bytes: float = 1000.0

    def steps(
        self, controls: Mapping[str, Any], demand: Demand, span: float, output_step: float
    ) -> tuple[float, float]:
        """Return the number of steps of a run, and of evaluations of the right-hand side."""
        step = min(controls["step"], output_step)
        while demand.rate * step > 2.0:  # the solver halves it until the iteration converges
            step *= 0.5
        return span / step, span / step * _iterations(demand.rate * step, controls)

    def seconds(self, steps: float, evaluations: float, pairs: float) -> float:
        """Return the seconds for these numbers of steps, evaluations and row pairs."""
        by_step = self.step_seconds + self.pair_seconds * pairs
        by_evaluation = self.evaluation_seconds + self.evaluation_pair_seconds * pairs
        return steps * by_step + evaluations * by_evaluation

    def memory(self, demand: Demand) -> float:
        """Return the bytes of the state and the work arrays."""
        return self.pair_bytes * demand.pairs


def _iterations(angle: float, controls: Mapping[str, Any]) -> float:
    """Return the number of iterations of a step, which starts from a guess of order six."""
    error = max(1e-30, (0.5 * angle) ** 6)
    count = 1.0
    while error > controls["tolerance"] and count < controls["iterations"]:
        error *= max(1e-3, min(0.9, 0.5 * angle))
        count += 1.0
    return count


class CrankNicolson(Method):
    """The trapezoidal rule, solved by fixed-point iteration."""

    name, label, order = "crank_nicolson", "Crank\N{EN DASH}Nicolson", 2
    controls = {
        "step": Control(0.0025),
        "tolerance": Control(1e-13, at_least=1e-14, below=1.0),
        "iterations": Control(50, at_least=2, at_most=1000, is_integer=True),
    }
    cost = IteratedCost()
    step_divides_outputs = True
    look = ("#e0a100", "s")

    def integrates(self, model: Model) -> bool:
        """Return whether the equations are autonomous."""
        return not model.driven

    def kernels(self) -> ModuleType:
        """Return the compiled scheme."""
        from latticode.integrators import crank_nicolson

        return crank_nicolson


class DelfourFortinPayre(CrankNicolson):
    """The variant of Crank-Nicolson that conserves the energy.

    Its rule is the mean of the right-hand side over a step, which cannot be derived from a trace.
    """

    name, label = "delfour_fortin_payre", "Delfour\N{EN DASH}Fortin\N{EN DASH}Payre"
    rule = "mean_rates"
    look = ("#7a2e0e", "v")

    def integrates(self, model: Model) -> bool:
        """Return False: traced models do not provide the mean of the right-hand side."""
        return False

    def build(self, rule: Callable, observe: Callable, **more: Any) -> Callable:
        """Return the function `solve`, built from the mean of the rates over a step."""
        return self.kernels().build_conserving(rule, observe, **more)
