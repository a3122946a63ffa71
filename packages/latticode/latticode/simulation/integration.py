"""What a run needs to know of a model beyond its equations: how it starts, and what is kept of it.

All of it follows from the trace of a model (`systems.integration_of`). A model whose kernels are
written with more knowledge declares an `Integration` of its own: see `Model.integration`.
"""

from collections.abc import Callable, Mapping
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from latticode.generation.chain import can_be_tiled

from .lattice import Reduction, aligned, find_reduction, pack
from .observables import blank_state_record
from .problem import Problem


class IntegrationError(RuntimeError):
    """A run that could not reach its end time with the digits that were asked for."""


class GaveUpError(IntegrationError):
    """A run whose solver could not go on: its state was not finite, or its steps were too short."""


class Solver(NamedTuple):
    """A compiled run, the names of its controls in their order, and the number of work arrays.

    `tiled` gives the smaller number of a chain of so many sites that may go in tiles.
    """

    run: Callable
    controls: tuple[str, ...]
    work: int
    tiled: Callable[[int], int] | None = None

    def room_for(self, chain, y: np.ndarray) -> np.ndarray:
        """Return the work arrays for a state (row, 1 + site) of `chain`."""
        tiled = self.tiled and can_be_tiled.py_func(chain)
        count = self.tiled(y.shape[1] - 2) if tiled else self.work
        return aligned((count, *y.shape))


class Words(NamedTuple):
    """What datasets call the results of a run; where nothing stands, the registry has the name."""

    measured: str = "Norms"
    units: str = "1"  # of the fields
    norms: str = ""  # ", of ...", behind the long names of norms
    component: str = "field"
    modulus: str = ""
    part: str = ""
    final: str = ""
    state: str = ""
    keeps_final: bool = True  # whether the dataset of a run has the state at its end


ITERATED = "step", "tolerance", "iterations"
"""The controls of the schemes that are solved by fixed-point iteration."""


class Integration(NamedTuple):
    """The equations as `simulate` takes them. The names are those of datasets.

    The functions that take a `Reduction` see to the part of the chain that is integrated.
    """

    components: tuple[str, ...]
    parts: tuple[str, ...]  # of a component: the rows of a state, but for one that is zero
    solvers: Mapping[str, Solver]
    system: Callable[[Problem, Reduction], Any]  # the parameters of the kernels
    collect: Callable[[Problem, Any, np.ndarray, Reduction], dict[str, np.ndarray]]
    """From record, final state and reduction to what `Trajectory` holds of the whole chain."""
    rates: Callable[[Problem, float], dict[str, float]]
    """Bounds of the rates at which data of a size turn or grow, by the key that makes them."""
    describe: Callable[[Problem], dict[str, Any]]
    """The attributes of a dataset that say which equations were solved."""
    # empty arrays for the observables; the arguments are the numbers of components, sites and
    # times, `every`, and whether the energy is computed
    record: Callable[[int, int, int, int, bool], Any] = blank_state_record
    find_reduction: Callable[[Problem], Reduction] = lambda problem: find_reduction(
        problem.amplitudes
    )
    # the state at the start
    start: Callable[[Problem, Reduction], np.ndarray] = lambda problem, cut: pack(
        problem.amplitudes, cut
    )
    times: Callable[[Problem], np.ndarray] = attrgetter("times")  # in the time of the kernels
    slow: Callable[[Problem, float], float] = lambda problem, time: time  # back from such a time
    clock: Callable[[Problem], float] = lambda problem: 1.0  # units of the kernels' time in one
    atol: Callable[[Problem], float] = lambda problem: 1.0  # what a tolerance of 1 means
    words: Words = Words()
