"""The base class of equations: the kernels of a problem, and the names of its results.

`traced.TracedEquations` derives all of them from the trace of a model. A program with specialised
kernels defines a subclass, and a subclass of `Problem` with these `equations`.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from latticode.equations.initial_values import InitialValueProblem
from latticode.generation.chain import can_be_tiled
from latticode.integrators.method import Method

from .lattice import Reduction, aligned, find_reduction, pack
from .observables import ObservableRecord, blank_record


class IntegrationError(RuntimeError):
    """A run that cannot reach its end time with the requested accuracy."""


class GaveUpError(IntegrationError):
    """A run that its solver stopped, because the state is not finite or the steps are too short."""


class CompiledMethod(NamedTuple):
    """A method compiled with the equations of a model.

    `work` is the number of work arrays, or 0 if this number does not depend on the model.
    `in_tiles` is true if the kernels can divide a chain into tiles. `load_long` returns the variant
    for long chains; it is None if there is none.
    """

    method: Method
    run: Callable
    work: int = 0
    in_tiles: bool = False
    load_long: Callable[[], Callable] | None = None

    def is_long(self, system: Any, y: np.ndarray) -> bool:
        """Return whether the variant for long chains integrates a state `y` of a `system`."""
        sites, long_chains = y.shape[1] - 2, self.method.long_chains()
        if self.load_long is None or long_chains is None or sites <= long_chains.LONGER_THAN:
            return False
        return can_be_tiled.py_func(system)

    def run_for(self, system: Any, y: np.ndarray) -> Callable:
        """Return the compiled run for a state `y` of a `system`."""
        if self.load_long and self.is_long(system, y):
            return self.load_long()
        return self.run

    def work_for(self, system: Any, y: np.ndarray) -> np.ndarray:
        """Return the work arrays, (array, row, column), for a state `y` of a `system`."""
        sites, can_be_divided = y.shape[1] - 2, can_be_tiled.py_func(system)
        tiled = self.in_tiles and self.method.takes_tiles and can_be_divided
        count = self.work or self.method.work_arrays(sites, tiled)
        if self.is_long(system, y):
            count = self.method.long_chains().work_arrays(count, sites)
        return aligned((count, *y.shape))

    def controls_of(self, solver: Mapping[str, Any], atol_scale: float = 1.0) -> tuple[float, ...]:
        """Return the kernels' controls, with the absolute tolerance times `atol_scale`."""
        scales = {"atol": atol_scale}
        return tuple(float(solver[key]) * scales.get(key, 1.0) for key in self.method.controls)


class ResultNames(NamedTuple):
    """Names of results in datasets; an empty text keeps the default long name of the variable."""

    components: tuple[str, ...]
    parts: tuple[str, ...] = ("re", "im")  # rows of a component, except a row that is always zero
    title: str = "Norms"
    units: str = "1"  # of the fields
    norms: str = ""  # ", of ...", appended to the long names of norms
    component: str = "field"
    modulus: str = ""
    part: str = ""
    final: str = ""
    state: str = ""
    quantities: tuple[str, ...] = ()  # conserved quantities stored as separate variables
    time: str = "t"


class BatchInputs(NamedTuple):
    """The kernel of a batch of runs, and its inputs (see latticode.generation.batches)."""

    run: Callable
    work: int  # arrays of the size of a state for the series of a run alone
    system: Any
    constants: Sequence[tuple[float, ...]]  # of each run


class Equations(ABC):
    """The equations of one problem, as `simulate` integrates them.

    A subclass defines the abstract members, and may replace the others. The first group of methods
    needs no kernels; the second group compiles them. A `cut` is the `Reduction` of the chain that
    is integrated.
    """

    stores_final = True
    """Whether the dataset of a run contains the final state."""

    def __init__(self, problem: InitialValueProblem) -> None:
        self.problem = problem

    # --- Names, units and bounds, known before a run

    @property
    @abstractmethod
    def names(self) -> ResultNames:
        """The names of the results in datasets."""

    @property
    @abstractmethod
    def methods(self) -> Sequence[str]:
        """The names of the methods that integrate the equations."""

    @abstractmethod
    def describe(self) -> dict[str, Any]:
        """Return the attributes of a dataset that describe the equations."""

    @abstractmethod
    def rates(self, peak: float) -> dict[str, float]:
        """Return bounds of the rates at amplitude `peak`, each by the key that it depends on."""

    @property
    def clock(self) -> float:
        """Units of the kernels' time per unit of the problem's time."""
        return 1.0

    @property
    def atol_scale(self) -> float:
        """Absolute tolerance of the kernels that corresponds to the tolerance 1 of the problem."""
        return 1.0

    # --- Arguments and results of the kernels

    def find_reduction(self) -> Reduction:
        """Return the smallest part of the chain that gives the same bits as the whole chain."""
        return find_reduction(self.problem.amplitudes)

    @abstractmethod
    def compiled(self, name: str) -> CompiledMethod:
        """Return the method of this name with the kernels of the equations."""

    @abstractmethod
    def system(self, cut: Reduction) -> Any:
        """Return the argument `system` of the kernels, with all parameters."""

    def start(self, cut: Reduction) -> np.ndarray:
        """Return the initial state, (row, 1 + site + 1) with ghosts."""
        return pack(self.problem.amplitudes, cut)

    def prepare_batch(self, batch: Sequence["Equations"], cut: Reduction) -> BatchInputs | None:
        """Return what a batch of runs of these equations needs; None if it is impossible."""
        return None

    @property
    def times(self) -> np.ndarray:
        """The output times, (time,), in units of the kernels' time."""
        return self.problem.times

    def time_of_problem(self, time: float) -> float:
        """Return a time of the kernels in units of the problem's time."""
        return time

    def record(
        self, components: int, sites: int, times: int, every: int, conserved: bool
    ) -> ObservableRecord:
        """Return uninitialised arrays for the observables at `times` outputs."""
        return blank_record(components, sites, times, every, parts=2)

    @abstractmethod
    def collect(self, record: ObservableRecord, y: np.ndarray, cut: Reduction) -> dict[str, Any]:
        """Return entries of a `Trajectory` on the whole chain, from record and final state `y`."""
