"""Kahan and Li's symplectic composition of order eight, for second-order equations."""

from types import ModuleType

from latticode.equations.model import Model
from latticode.integrators.method import Control, FixedStepCost, Method


class KahanLi(Method):
    """Kahan and Li's symplectic composition of order eight, for second-order equations.

    Its control is the longest step, in units of the kernels' time.
    """

    name, label, order = "kahan_li", "Kahan\N{EN DASH}Li", 8
    controls = {"step": Control(0.25)}
    cost = FixedStepCost(step_seconds=2e-6, pair_seconds=3e-7)
    continues_exactly = True
    look = ("#c2558f", "X")

    def integrates(self, model: Model) -> bool:
        """Return whether the equations are x'' = f(x, t), with forces independent of velocities."""
        return model.separable

    def kernels(self) -> ModuleType:
        """Return the compiled method."""
        from latticode.integrators import kahan_li

        return kahan_li
