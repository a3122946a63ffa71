"""The Taylor method: each step sums the power series of the solution."""

from collections.abc import Mapping
from math import frexp
from types import ModuleType
from typing import Any

from latticode.equations.model import Model
from latticode.integrators.method import COARSEST, AdaptiveCost, Control, Method, Obstacle
from latticode.numerics.elementary import log

LARGEST_EXPONENT = 270.0
"""Largest decimal exponent, positive or negative, of the last coefficients of a series."""


class Taylor(Method):
    """The Taylor method, the default, because it is the fastest at small errors."""

    name, label, order = "taylor", "Taylor", 16
    rule = "continue_series"
    controls = {"rtol": Control(1e-14, at_least=1e-16, at_most=COARSEST), "atol": Control(1e-14)}
    cost = AdaptiveCost(
        0.16,
        15,
        step_seconds=6e-7,
        pair_seconds=1.5e-7,
        pair_bytes=1400,
        cached_pairs=8192,
        further_pair_bytes=600,
    )
    tightest = 1e-14
    look = ("#7b4fa3", "D")

    def integrates(self, model: Model) -> bool:
        """Return whether the equations have a power series."""
        return not model.why_no_series

    def find_obstacle(
        self, controls: Mapping[str, Any], peak: float, span: float, rate: float
    ) -> Obstacle | None:
        """Return an obstacle if the last coefficients leave the range of doubles, else None.

        At rest the last coefficients may vanish.
        """
        if peak == 0.0 or rate * span < 1e-6:
            return None
        octaves = abs(frexp(peak)[1]) + self.order * (abs(frexp(rate)[1]) + 1)
        if octaves < LARGEST_EXPONENT:  # the usual case; 2**n < 10**n, so no logarithm is needed
            return None
        power = (log(peak) + self.order * log(rate)) / log(10.0)
        if abs(power) > LARGEST_EXPONENT:
            text = f"the power series needs numbers of 1e{power:.0f}: choose another unit of time"
            return "end_time", text
        return None

    def kernels(self) -> ModuleType:
        """Return the compiled method."""
        from latticode.integrators import taylor

        return taylor

    def long_chains(self) -> ModuleType:
        """Return the variant that needs memory for the series of a few blocks only."""
        from latticode.integrators import long_taylor

        return long_taylor
