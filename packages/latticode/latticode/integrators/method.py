"""The interface of a time integrator: one object with all that the library needs to know about it.

A `Method` has a name and a label, the controls that a user may set, the models that it integrates,
the cost of a step, and its kernels. Configuration, checks, `auto`, cost estimates, figures and
generated kernels read these. Each file in `methods` defines one method.

Such a file is imported with the configuration, before any run starts. numba takes 0.1 s to load and
is therefore imported only in `build` or in the module that `kernels` returns.
"""

import sys
from collections.abc import Callable, Mapping
from math import inf
from types import ModuleType
from typing import Any, ClassVar, NamedTuple, Protocol

from latticode.equations.model import Model

COARSEST = 0.1
"""Largest tolerance of a step. Error estimates hold only for small errors."""
SMALLEST_ERROR = 1e-150
"""Smallest tolerance of methods that square errors: the square of a smaller error underflows."""

Obstacle = tuple[str, str]
"""A key of a case and the reason why its value prevents the integration."""


class Control(NamedTuple):
    """A positive number that controls a method: its default and its allowed range."""

    default: float
    at_least: float | None = None
    at_most: float | None = None
    below: float | None = None
    is_integer: bool = False


class Demand(NamedTuple):
    """Properties of a problem that determine its cost, besides its method and times."""

    rate: float  # fastest phase rate, in radians per unit of time
    pairs: float  # number of row pairs (fields times sites) that are integrated
    clock: float = 1.0  # units of the kernels' time per unit of the problem's time
    in_parts: bool = False  # whether a long chain may be integrated a few blocks at a time


class Cost(Protocol):
    """An estimate of the cost of a run, within a factor of 3 of measured times."""

    def steps(
        self, controls: Mapping[str, Any], demand: Demand, span: float, output_step: float
    ) -> tuple[float, float]:
        """Return the steps of a run, and the evaluations of a scheme solved by iteration."""

    def seconds(self, steps: float, evaluations: float, pairs: float) -> float:
        """Return the seconds for these numbers of steps, evaluations and row pairs."""

    def memory(self, demand: Demand) -> float:
        """Return the bytes of the state and the work arrays."""


class AdaptiveCost(NamedTuple):
    """Steps = per_angle * angle * tolerance ** (-1 / order), for a method with error control."""

    per_angle: float
    order: float
    step_seconds: float  # per step, for any chain
    pair_seconds: float  # per step and row pair
    pair_bytes: float  # of the state and the work arrays, per row pair
    cached_pairs: float = inf  # row pairs that fit into the cache; if the chain is integrated in
    further_pair_bytes: float = 0.0  # parts, each row pair in addition to them needs these bytes

    def steps(
        self, controls: Mapping[str, Any], demand: Demand, span: float, output_step: float
    ) -> tuple[float, float]:
        """Return the number of steps, from the angle by which phases advance during the run."""
        tolerance = max(controls["rtol"], 1e-17) ** (-1.0 / self.order)
        return max(1.0, self.per_angle * demand.rate * span * tolerance), 0.0

    def seconds(self, steps: float, evaluations: float, pairs: float) -> float:
        """Return the seconds that the steps take."""
        return steps * (self.step_seconds + self.pair_seconds * pairs)

    def memory(self, demand: Demand) -> float:
        """Return the bytes of the state and the work arrays."""
        cached = min(demand.pairs, self.cached_pairs) if demand.in_parts else demand.pairs
        return self.pair_bytes * cached + self.further_pair_bytes * (demand.pairs - cached)


class FixedStepCost(NamedTuple):
    """Cost of equal steps between two outputs, none longer than the control `step`."""

    step_seconds: float
    pair_seconds: float
    pair_bytes: float = 1000.0

    def steps(
        self, controls: Mapping[str, Any], demand: Demand, span: float, output_step: float
    ) -> tuple[float, float]:
        """Return the number of steps of a run; `step` is in units of the kernels' time."""
        longest = min(controls["step"], output_step * demand.clock)
        return span * demand.clock / longest, 0.0

    def seconds(self, steps: float, evaluations: float, pairs: float) -> float:
        """Return the seconds that the steps take."""
        return steps * (self.step_seconds + self.pair_seconds * pairs)

    def memory(self, demand: Demand) -> float:
        """Return the bytes of the state and the work arrays."""
        return self.pair_bytes * demand.pairs


class Method:
    """A time integrator. Each subclass is defined in a file of `methods`.

    `name` is the name in configurations, `label` the one in figures, and `order` the order of the
    global error in the step. `controls` are those of `solve`, in the same order. `tightest` is the
    relative tolerance at which the method checks runs of other methods; None without error control.
    `look` is its colour and marker in figures. `rule` names the function of the equations that
    `build` takes: "rates", the right-hand side, or "continue_series", the rule of their power
    series.
    """

    name: ClassVar[str]
    label: ClassVar[str]
    order: ClassVar[int]
    controls: ClassVar[Mapping[str, Control]]
    cost: ClassVar[Cost]
    rule: ClassVar[str] = "rates"
    tightest: ClassVar[float | None] = None
    step_divides_outputs: ClassVar[bool] = False
    """Whether the control `step` must divide the time between two outputs."""
    continues_exactly: ClassVar[bool] = False
    """Whether a continued run has the bits of a single run, because its steps end at outputs and
    depend only on the state."""
    takes_tiles: ClassVar[bool] = False
    """Whether `build` takes the arguments `can_be_tiled` and `system_of_tile` (see `dop853`)."""
    look: ClassVar[tuple[str, str] | None] = None

    def integrates(self, model: Model) -> bool:
        """Return whether the method integrates the equations of a traced model."""
        return True

    def find_obstacle(
        self, controls: Mapping[str, Any], peak: float, span: float, rate: float
    ) -> Obstacle | None:
        """Return why this method cannot integrate data of amplitude `peak`, None if it can.

        `span` is the length of the run and `rate` the phase rate of the data, in the kernels' time.
        """
        return None

    def kernels(self) -> ModuleType:
        """Return the module with `build` and `WORK`, as the package `integrators` describes them.

        By default this is the file that defines the method.
        """
        return sys.modules[type(self).__module__]

    def long_chains(self) -> ModuleType | None:
        """Return the module with the variant of this method for long chains, None if none exists.

        It has `build`, `work_arrays`, and the number of sites that a chain is LONGER_THAN.
        """
        return None

    def build(self, rule: Callable, observe: Callable, **more: Any) -> Callable:
        """Return the function `solve` for a model's `rule` and `observe`.

        `more` holds `at_time` if the equations depend on time, and `can_be_tiled` and
        `system_of_tile` for a method that `takes_tiles`.
        """
        return self.kernels().build(rule, observe, **more)

    def work_arrays(self, sites: int, in_tiles: bool) -> int:
        """Return how many work arrays of the size of a state a run on `sites` sites needs."""
        return self.kernels().WORK
