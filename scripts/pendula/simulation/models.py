"""What a run needs to know of a model: how it starts, which solvers there are, what is kept.

A model is a set of functions and names; `MODELS` has one for each name that a problem may give.
"""

from collections.abc import Callable, Mapping
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
from latticode.numerics.elementary import complex_of, modulus

from pendula.models.amplitudes import Chain
from pendula.models.pendula import angles_of, make_pendula, swings_of, times_of
from pendula.problem import AMPLITUDES, PENDULA, Constants, Problem

from . import pendula_solvers, solvers
from .lattice import Reduction, choose_ends, find_reduction, pack, unfold, unpack
from .observables import blank_record, blank_state_record
from .own_models import conserved_in, find_reduction_of_own, make_system, solvers_of
from .solvers import Solver


class Model(NamedTuple):
    """The equations as `simulate` takes them. The names are those of datasets.

    The functions that take a `reduction` see to the part of the chain that is integrated. What is
    the same for all but the pendula has a default.
    """

    components: tuple[str, ...]
    parts: tuple[str, str]  # of a component: the two rows of a state
    solvers: Mapping[str, Solver]
    system: Callable[[Problem, Reduction], Any]  # the parameters of the kernels
    collect: Callable[[Problem, Any, np.ndarray, Reduction], dict[str, np.ndarray]]
    """From record, final state and reduction to what `Trajectory` holds of the whole chain."""
    # empty arrays for the observables; the arguments are the numbers of components, sites and
    # times, `every`, and whether the energy is computed
    record: Callable[[int, int, int, int, bool], Any] = blank_state_record
    find_reduction: Callable[[Problem], Reduction] = lambda problem: find_reduction(
        problem.amplitudes
    )
    # the state at tau = 0
    start: Callable[[Problem, Reduction], np.ndarray] = lambda problem, cut: pack(
        problem.amplitudes, cut
    )
    times: Callable[[Problem], np.ndarray] = attrgetter("times")  # in the time of the kernels
    slow: Callable[[Problem, float], float] = lambda problem, time: time  # tau at such a time
    atol: Callable[[Problem], float] = lambda problem: 1.0  # what a tolerance of 1 means


# --- The amplitudes -----------------------------------------------------------------------------


def make_chain(constants: Constants, boundary: str, reduction: Reduction) -> Chain:
    """Return the parameters of the kernels: the constants, and the ends of the integrated part."""
    ends = choose_ends(boundary, reduction)
    return Chain(float(constants.epsilon), float(constants.gamma), float(constants.omega), *ends)


def _collect_amplitudes(
    problem: Problem, record, y: np.ndarray, reduction: Reduction
) -> dict[str, np.ndarray]:
    modulus = unfold(record.kept, reduction)
    return {"energy": record.energy, "modulus": modulus, "final": unpack(y, reduction)}


# --- The pendula --------------------------------------------------------------------------------


def _start_pendula(problem: Problem, reduction: Reduction) -> np.ndarray:
    angles, velocities = angles_of(problem.amplitudes, problem.constants.omega, problem.mu)
    return pack(complex_of(angles, velocities), reduction)


def _collect_pendula(
    problem: Problem, record, y: np.ndarray, reduction: Reduction
) -> dict[str, np.ndarray]:
    final = [unfold(y[part::2, 1:-1], reduction) for part in (0, 1)]
    snapshots = np.array([unfold(part, reduction) for part in record.kept])
    return {
        "energy": record.energy,
        # a snapshot finds all pendula at one phase of their swing: their angles alone would show it
        "modulus": swings_of(*snapshots, problem.constants.omega, problem.mu),
        "final": np.array(final),
        "snapshots": snapshots,
    }


MODELS = {
    AMPLITUDES: Model(
        components=("A", "B"),
        parts=("re", "im"),
        solvers=solvers.SOLVERS,
        system=lambda problem, cut: make_chain(problem.constants, problem.boundary, cut),
        record=blank_record,
        collect=_collect_amplitudes,
    ),
    PENDULA: Model(
        components=("x", "y"),
        parts=("angle", "velocity"),
        solvers=pendula_solvers.SOLVERS,
        system=lambda problem, cut: make_pendula(
            problem.constants, problem.mu, choose_ends(problem.boundary, cut)
        ),
        start=_start_pendula,
        times=lambda problem: times_of(problem.times, problem.mu),
        slow=lambda problem, time: 0.5 * problem.mu * problem.mu * time,
        # tolerances are those of the amplitudes, so that they mean the same at any mu
        atol=lambda problem: 2.0 * problem.mu,
        collect=_collect_pendula,
    ),
}
"""The models by name."""


# --- Models of a user's own ---------------------------------------------------------------------


def _collect_own(problem: Problem, record, y: np.ndarray, cut: Reduction) -> dict[str, np.ndarray]:
    parts = np.array([unfold(y[part::2, 1:-1], cut) for part in (0, 1)])
    snapshots = np.array([unfold(part, cut) for part in record.kept])
    real = problem.model.second_order
    return {
        "energy": record.energy,
        "modulus": np.abs(snapshots[0]) if real else modulus(complex_of(*snapshots)),
        "final": parts if real else complex_of(*parts),
        "snapshots": snapshots,
        "conserved": conserved_in(problem, snapshots),
    }


def model_of(problem: Problem) -> Model:
    """Return the model of a problem; a traced one is compiled when it is run."""
    if not problem.is_own:
        return MODELS[problem.model]
    return Model(
        components=problem.model.fields,
        parts=("value", "rate") if problem.model.second_order else ("re", "im"),
        solvers=solvers_of(problem),
        system=make_system,
        collect=_collect_own,
        find_reduction=find_reduction_of_own,
    )
