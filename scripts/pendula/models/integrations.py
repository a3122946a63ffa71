"""How the paper's equations are integrated: by kernels that know more than their trace.

(4) has both symmetries, energy (8) at every output, and two schemes more. Pendula start from
amplitudes, count the time t, and are shown as the angle to which they swing.
"""

import numpy as np
from latticode.datasets.registry import NAMES
from latticode.numerics.elementary import complex_of, modulus
from latticode.simulation.integration import Integration, Words
from latticode.simulation.lattice import Reduction, choose_ends, pack, unfold, unpack
from latticode.simulation.observables import blank_record

from pendula import names  # noqa: F401, whose words stand below
from pendula.feasibility import clock_of, rates_of
from pendula.problem import AMPLITUDES, PENDULA, Constants, Problem

from . import amplitudes, pendula, pendula_solvers, solvers
from .amplitudes import Chain
from .pendula import angles_of, make_pendula, swings_of, times_of

# --- The amplitudes -----------------------------------------------------------------------------


def make_chain(constants: Constants, boundary: str, reduction: Reduction) -> Chain:
    """Return the parameters of the kernels: the constants, and the ends of the integrated part."""
    ends = choose_ends(boundary, reduction)
    return Chain(float(constants.epsilon), float(constants.gamma), float(constants.omega), *ends)


def _collect_amplitudes(
    problem: Problem, record, y: np.ndarray, reduction: Reduction
) -> dict[str, np.ndarray]:
    found = {"energy": record.energy, "final": unpack(y, reduction)}
    if record.kept.ndim == 3:
        return {**found, "modulus": unfold(record.kept, reduction)}
    state = np.array([unfold(part, reduction) for part in record.kept])
    return {**found, "modulus": modulus(complex_of(*state)), "state": state}


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
        "state": snapshots,
    }


PARTS = ("angle", "velocity")

amplitudes.AMPLITUDES.integration = Integration(
    components=("A", "B"),
    parts=("re", "im"),
    solvers=solvers.SOLVERS,
    system=lambda problem, cut: make_chain(problem.constants, problem.boundary, cut),
    record=blank_record,
    collect=_collect_amplitudes,
    rates=lambda problem, peak: rates_of(problem.constants, peak),
    describe=lambda problem: dict(problem.parameters),
    words=Words("Norms and energy", component=NAMES["component"], keeps_final=False),
)
pendula.NEWTON.integration = Integration(
    components=("x", "y"),
    parts=PARTS,
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
    rates=lambda problem, peak: rates_of(problem.constants, peak, problem.mu),
    clock=lambda problem: clock_of(problem.mu),
    describe=lambda problem: {"model": PENDULA, **problem.parameters},
    words=Words(
        measured="Norms of the angles",
        units="rad",
        norms=", of the angles",
        component=NAMES["component"],
        modulus=f"{NAMES['modulus']}: the angle to which a pendulum swings",
        part=f"{NAMES['part']}, x + i x'",
        final=f"{NAMES['final']}, as angle and velocity of a pendulum",
        state=f"{NAMES['state']}, as angle and velocity of a pendulum",
    ),
)
NAMED = {AMPLITUDES: amplitudes.AMPLITUDES, PENDULA: pendula.NEWTON}
"""The models by name."""
