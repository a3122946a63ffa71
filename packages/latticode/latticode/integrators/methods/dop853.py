"""DOP853, the explicit Runge-Kutta method of order eight of Dormand and Prince."""

from collections.abc import Mapping
from types import ModuleType
from typing import Any

from latticode.integrators.method import (
    COARSEST,
    SMALLEST_ERROR,
    AdaptiveCost,
    Control,
    Method,
    Obstacle,
)


def find_vanishing_square(controls: Mapping[str, Any]) -> Obstacle | None:
    """Return the absolute tolerance as an obstacle if its square underflows, else None."""
    atol = float(controls["atol"])
    if atol >= SMALLEST_ERROR:
        return None
    text = f"the square of the absolute tolerance {atol:g} underflows: use {SMALLEST_ERROR:g}"
    return "solver.atol", text


class Dop853(Method):
    """The explicit Runge-Kutta method of order eight, for accuracy."""

    name, label, order = "dop853", "DOP853", 8
    controls = {"rtol": Control(1e-13, at_least=1e-15, at_most=COARSEST), "atol": Control(1e-13)}
    cost = AdaptiveCost(0.11, 8, step_seconds=1.2e-6, pair_seconds=7.5e-8, pair_bytes=800)
    tightest = 1e-13
    takes_tiles = True
    look = ("#16876b", "^")

    def find_obstacle(
        self, controls: Mapping[str, Any], peak: float, span: float, rate: float
    ) -> Obstacle | None:
        """Return the absolute tolerance as an obstacle if its square underflows, else None."""
        return find_vanishing_square(controls)

    def kernels(self) -> ModuleType:
        """Return the compiled method."""
        from latticode.integrators import dop853

        return dop853

    def work_arrays(self, sites: int, in_tiles: bool) -> int:
        """Return the number of work arrays of the size of a state; a chain in tiles needs fewer."""
        kernels = self.kernels()
        return kernels.work_arrays(sites) if in_tiles else kernels.WORK
