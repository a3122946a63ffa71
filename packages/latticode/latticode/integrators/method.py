"""The contract of a time integrator: one object that says all that the library needs to know of it.

A `Method` has a name and a label, the controls that a user may set, the models that it takes, what
a step costs, and the kernels that make a run. Configuration, checks, `auto`, estimates of costs,
figures and generated kernels read these. Files in `methods` define one method each.

Such a file is read with the configuration, before any run starts. So numba, which takes a tenth of
a second to load, is imported inside `build` or in the module that `kernels` returns.
"""

import sys
from collections.abc import Mapping
from types import ModuleType
from typing import Any, ClassVar, NamedTuple, Protocol

from latticode.equations.model import Model

COARSEST = 0.1
"""Largest tolerance of a step's error: the estimate of that error holds for small errors only."""
SMALLEST_ERROR = 1e-150
"""The square of a smaller error vanishes, and with it the step control of methods that square."""

Obstacle = tuple[str, str]
"""The key of a case because of which it cannot be integrated, and the reason."""


class Control(NamedTuple):
    """A positive number that controls a method: its default, and the values that it may have."""

    default: float
    at_least: float | None = None
    at_most: float | None = None
    below: float | None = None
    is_integer: bool = False


class Demand(NamedTuple):
    """What decides the cost of a problem besides its method and its times."""

    rate: float  # the fastest at which the data turn, per unit of time
    pairs: float  # of fields that are integrated
    clock: float = 1.0  # units of the equations' own time in one of the problem


class Cost(Protocol):
    """How many steps a method takes and what each costs; measured, so estimates are within 3."""

    pair_bytes: float

    def steps(
        self, controls: Mapping[str, Any], demand: Demand, span: float, output_step: float
    ) -> tuple[float, float]:
        """Return the steps of a run, and the evaluations of a scheme solved by iteration."""

    def seconds(self, steps: float, evaluations: float, pairs: float) -> float:
        """Return the seconds that so many steps take for so many pairs of fields."""


class AdaptiveCost(NamedTuple):
    """Steps = per_angle * angle * tolerance ** (-1 / order), for a method with error control."""

    per_angle: float
    order: float
    step_seconds: float  # a step, whatever the chain
    pair_seconds: float  # a step and a pair of fields
    pair_bytes: float  # of the state and the work arrays, a pair

    def steps(
        self, controls: Mapping[str, Any], demand: Demand, span: float, output_step: float
    ) -> tuple[float, float]:
        """Return the steps of a run by the angle through which its data turn."""
        tolerance = max(controls["rtol"], 1e-17) ** (-1.0 / self.order)
        return max(1.0, self.per_angle * demand.rate * span * tolerance), 0.0

    def seconds(self, steps: float, evaluations: float, pairs: float) -> float:
        """Return the seconds that the steps take."""
        return steps * (self.step_seconds + self.pair_seconds * pairs)


class FixedStepCost(NamedTuple):
    """Equal steps between two outputs, none longer than the control `step`."""

    step_seconds: float
    pair_seconds: float
    pair_bytes: float = 1000.0

    def steps(
        self, controls: Mapping[str, Any], demand: Demand, span: float, output_step: float
    ) -> tuple[float, float]:
        """Return the steps of a run in the time of the equations."""
        longest = min(controls["step"], output_step * demand.clock)
        return span * demand.clock / longest, 0.0

    def seconds(self, steps: float, evaluations: float, pairs: float) -> float:
        """Return the seconds that the steps take."""
        return steps * (self.step_seconds + self.pair_seconds * pairs)


class Method:
    """A time integrator. A subclass sets what differs, in one file of `methods`.

    `name` is what users write, `label` what figures print, `order` the order of its error in the
    step. `controls` are those of `solve`, in its order. `tightest` is the relative tolerance at
    which the method checks runs of others; None for one without error control. `look` is its colour
    and its marker in figures. `rule` names what `build` takes of the equations: "rates", the
    right-hand side, or "continue_series", the rule of their power series.
    """

    name: ClassVar[str]
    label: ClassVar[str]
    order: ClassVar[int]
    controls: ClassVar[Mapping[str, Control]]
    cost: ClassVar[Cost]
    rule: ClassVar[str] = "rates"
    tightest: ClassVar[float | None] = None
    step_divides_outputs: ClassVar[bool] = False
    """Whether its `step` must divide the time between two outputs."""
    continues_exactly: ClassVar[bool] = False
    """Whether a run that starts where another ended has the bits of one run: steps end at outputs,
    and begin with nothing but the state."""
    takes_tiles: ClassVar[bool] = False
    """Whether `build` takes `can_be_tiled` and `system_of_tile`: see `dop853`."""
    look: ClassVar[tuple[str, str] | None] = None

    def integrates(self, model: Model) -> bool:
        """Return whether the method integrates the equations of a traced model."""
        return True

    def find_obstacle(
        self, controls: Mapping[str, Any], peak: float, span: float, rate: float
    ) -> Obstacle | None:
        """Return why this method cannot integrate data of the size `peak`, None if it can.

        `span` is the length of the run and `rate` how fast the data turn, in the equations' time.
        """
        return None

    def kernels(self) -> ModuleType:
        """Return the module with `build` and `WORK`, as the package `integrators` describes them.

        It is the method's own file unless a subclass imports another one here.
        """
        return sys.modules[type(self).__module__]

    def build(self, rule, observe, **more):
        """Return the function `solve` of a model's `rule` and `observe`.

        `more` is `at_time` where the equations depend on the time, and for a method that
        `takes_tiles` what it needs for them.
        """
        return self.kernels().build(rule, observe, **more)

    def work_arrays(self, sites: int, in_tiles: bool) -> int:
        """Return how many arrays of the size of a state a run on so many sites needs."""
        return self.kernels().WORK
