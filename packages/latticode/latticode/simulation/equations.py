"""How a problem is integrated, and what its results are called: the base class of all equations.

All of it follows from the trace of a model (`traced.TracedEquations`). A program whose kernels know
more than the trace of their model says so in a class of its own, which its problems name: see
`Problem.equations`.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from latticode.equations.initial_values import InitialValueProblem
from latticode.generation.chain import can_be_tiled
from latticode.integrators.method import Method

from .lattice import Reduction, aligned, find_reduction, pack
from .observables import ObservableRecord, blank_record


class IntegrationError(RuntimeError):
    """A run that could not reach its end time with the digits that were asked for."""


class GaveUpError(IntegrationError):
    """A run whose solver could not go on: its state was not finite, or its steps were too short."""


class CompiledMethod(NamedTuple):
    """A method with the equations of a model: one compiled run.

    `work` is the number of work arrays where it depends on the model. `in_tiles` says that the
    kernels let a chain go in tiles.
    """

    method: Method
    run: Callable
    work: int = 0
    in_tiles: bool = False

    def work_for(self, system, y: np.ndarray) -> np.ndarray:
        """Return the work arrays for a state (row, 1 + site) of a `system`."""
        tiled = self.in_tiles and self.method.takes_tiles and can_be_tiled.py_func(system)
        count = self.work or self.method.work_arrays(y.shape[1] - 2, tiled)
        return aligned((count, *y.shape))

    def controls_of(self, solver: Mapping[str, Any], atol_scale: float = 1.0) -> tuple[float, ...]:
        """Return the controls as kernels take them; `atol_scale` is what a tolerance of 1 means."""
        scales = {"atol": atol_scale}
        return tuple(float(solver[key]) * scales.get(key, 1.0) for key in self.method.controls)


class ResultNames(NamedTuple):
    """What datasets call the results of a run; an empty text leaves the name to the registry."""

    components: tuple[str, ...]
    parts: tuple[str, ...] = ("re", "im")  # rows of a component, but for one that is zero
    title: str = "Norms"
    units: str = "1"  # of the fields
    norms: str = ""  # ", of ...", behind the long names of norms
    component: str = "field"
    modulus: str = ""
    part: str = ""
    final: str = ""
    state: str = ""
    quantities: tuple[str, ...] = ()  # conserved, finite, and variables of their own
    time: str = "t"


class Equations:
    """One problem as `simulate` integrates it. A subclass gives what differs from these defaults.

    Names and units come first and need no kernels; what comes below compiles them when a run
    starts. Methods that take a `cut`, a `Reduction`, see to the part of the chain that is
    integrated.
    """

    stores_final = True
    """Whether the dataset of a run has the state at its end."""

    def __init__(self, problem: InitialValueProblem):
        self.problem = problem

    # --- Names, units, and what is known before a run

    @property
    def names(self) -> ResultNames:
        """What datasets call the results."""
        raise NotImplementedError

    @property
    def methods(self) -> Sequence[str]:
        """The names of the methods that integrate the equations."""
        raise NotImplementedError

    def describe(self) -> dict[str, Any]:
        """Return the attributes of a dataset that say which equations were solved."""
        raise NotImplementedError

    def rates(self, peak: float) -> dict[str, float]:
        """Return bounds of the rates at which data of this size turn or grow, by their key."""
        raise NotImplementedError

    @property
    def clock(self) -> float:
        """How many units of the kernels' time make one of the problem's."""
        return 1.0

    @property
    def atol_scale(self) -> float:
        """The absolute tolerance of the kernels that a tolerance of 1 means."""
        return 1.0

    # --- What a run needs

    def find_reduction(self) -> Reduction:
        """Return the smallest part of the chain that has the bits of the whole."""
        return find_reduction(self.problem.amplitudes)

    def compiled(self, name: str) -> CompiledMethod:
        """Return the method of this name with the kernels of the equations."""
        raise NotImplementedError

    def system(self, cut: Reduction) -> Any:
        """Return the parameters of the kernels."""
        raise NotImplementedError

    def start(self, cut: Reduction) -> np.ndarray:
        """Return the state at the start, (row, 1 + site) with ghosts."""
        return pack(self.problem.amplitudes, cut)

    @property
    def times(self) -> np.ndarray:
        """The output times in the time of the kernels."""
        return self.problem.times

    def time_of_problem(self, time: float) -> float:
        """Return a time of the kernels in the time of the problem."""
        return time

    def record(
        self, components: int, sites: int, times: int, every: int, conserved: bool
    ) -> ObservableRecord:
        """Return empty arrays for what is observed at so many times."""
        return blank_record(components, sites, times, every, parts=2)

    def collect(self, record: ObservableRecord, y: np.ndarray, cut: Reduction) -> dict[str, Any]:
        """Return what a `Trajectory` holds of the whole chain, from record and final state."""
        raise NotImplementedError
