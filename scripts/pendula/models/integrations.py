"""How the paper's equations are integrated: by kernels that do more than those of a traced model.

The kernels of (4) use both symmetries, compute the energy (8) at every output, and add two methods.
Pendula start from amplitudes and have the time t; their modulus is the angle to which they swing.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from latticode.datasets.registry import NAMES
from latticode.numerics.elementary import complex_of, modulus
from latticode.simulation.equations import BatchInputs, CompiledMethod, Equations, ResultNames
from latticode.simulation.lattice import Reduction, choose_ends, pack, unfold, unpack
from latticode.simulation.observables import ObservableRecord, blank_record

from pendula import names  # noqa: F401, adds the names used below
from pendula.feasibility import clock_of, rates_of

from .amplitudes import AmplitudeChain
from .equations import AMPLITUDES, PENDULA, Constants
from .pendula import Pendula, angles_of, make_pendula, swings_of, times_of
from .solvers import SOLVERS


def make_chain(constants: Constants, boundary: str, cut: Reduction) -> AmplitudeChain:
    """Return the parameters of the kernels: the constants, and the ends of the reduced chain."""
    ends = choose_ends(boundary, cut)
    return AmplitudeChain(
        float(constants.epsilon), float(constants.gamma), float(constants.omega), *ends
    )


class PaperEquations(Equations):
    """Base class for (4) and (1): their constants and their compiled methods."""

    model_name: str

    @property
    def constants(self) -> Constants:
        """The constants of (4)."""
        return Constants.of(self.problem.parameters)

    @property
    def methods(self) -> Sequence[str]:
        """The names of the methods that integrate the equations."""
        return list(SOLVERS[self.model_name])

    def compiled(self, name: str) -> CompiledMethod:
        """Return the method of this name with the kernels of the equations."""
        return SOLVERS[self.model_name][name]


class AmplitudeEquations(PaperEquations):
    """A problem of (4), whose runs observe the energy (8)."""

    model_name = AMPLITUDES
    stores_final = False

    @property
    def names(self) -> ResultNames:
        """Names and units of the results in datasets."""
        return ResultNames(
            ("A", "B"),
            title="Norms and energy",
            component=NAMES["component"],
            quantities=("energy",),
            time="tau",
        )

    def describe(self) -> dict[str, Any]:
        """Return the constants, as attributes of a dataset."""
        return dict(self.problem.parameters)

    def rates(self, peak: float) -> dict[str, float]:
        """Return bounds on relative rates of change of amplitudes up to `peak`, by key."""
        return rates_of(self.constants, peak)

    def system(self, cut: Reduction) -> AmplitudeChain:
        """Return the parameters of the kernels."""
        return make_chain(self.constants, self.problem.boundary, cut)

    def prepare_batch(self, batch: Sequence[Equations], cut: Reduction) -> BatchInputs:
        """Return the kernel of a batch of runs and its inputs."""
        from .amplitude_batches import WORK, run_batch  # here: few programs need them

        constants = [tuple(Constants.of(each.problem.parameters)) for each in batch]
        return BatchInputs(run_batch, WORK, self.system(cut), constants)

    def record(
        self, components: int, sites: int, times: int, every: int, conserved: bool
    ) -> ObservableRecord:
        """Return empty arrays for moduli, norms and energy at `times` outputs."""
        return blank_record(components, sites, times, every, quantities=int(conserved))

    def collect(self, record: ObservableRecord, y: np.ndarray, cut: Reduction) -> dict[str, Any]:
        """Return energy, moduli or states, and final amplitudes of the full chain."""
        conserved = dict(zip(("energy",), record.conserved, strict=False))
        results = {"conserved": conserved, "final": unpack(y, cut)}
        if record.snapshots.ndim == 3:
            return {**results, "modulus": unfold(record.snapshots, cut)}
        state = np.array([unfold(part, cut) for part in record.snapshots])
        return {**results, "modulus": modulus(complex_of(*state)), "state": state}


class PendulumEquations(PaperEquations):
    """A problem of (1), given by amplitudes and times tau of (4)."""

    model_name = PENDULA

    @property
    def mu(self) -> float:
        """The small parameter mu; angles are of the size 2 mu |A|."""
        return self.problem.parameters["mu"]

    @property
    def names(self) -> ResultNames:
        """Names and units of the results in datasets; angles are in rad."""
        return ResultNames(
            ("x", "y"),
            ("angle", "velocity"),
            title="Norms of the angles",
            units="rad",
            time="tau",
            norms=", of the angles",
            component=NAMES["component"],
            modulus=f"{NAMES['modulus']}: the angle to which a pendulum swings",
            part=f"{NAMES['part']}, x + i x'",
            final=f"{NAMES['final']}, as angle and velocity of a pendulum",
            state=f"{NAMES['state']}, as angle and velocity of a pendulum",
        )

    def describe(self) -> dict[str, Any]:
        """Return the name of the model, the constants and mu, as attributes of a dataset."""
        return {"model": PENDULA, **self.problem.parameters}

    def rates(self, peak: float) -> dict[str, float]:
        """Return bounds on relative rates per unit of tau, for amplitudes up to `peak`, by key."""
        return rates_of(self.constants, peak, self.mu)

    @property
    def clock(self) -> float:
        """dt/dtau = 2 / mu^2."""
        return clock_of(self.mu)

    @property
    def atol_scale(self) -> float:
        """2 mu, the scale of absolute tolerances, which are given for the amplitudes."""
        return 2.0 * self.mu

    def system(self, cut: Reduction) -> Pendula:
        """Return the parameters of the kernels at time 0."""
        return make_pendula(self.constants, self.mu, choose_ends(self.problem.boundary, cut))

    def start(self, cut: Reduction) -> np.ndarray:
        """Return angles and velocities at t = 0."""
        angles, velocities = angles_of(self.problem.amplitudes, self.constants.omega, self.mu)
        return pack(complex_of(angles, velocities), cut)

    @property
    def times(self) -> np.ndarray:
        """The output times in t."""
        return times_of(self.problem.times, self.mu)

    def time_of_problem(self, time: float) -> float:
        """Return tau at a time t."""
        return 0.5 * self.mu * self.mu * time

    def collect(self, record: ObservableRecord, y: np.ndarray, cut: Reduction) -> dict[str, Any]:
        """Return swings, angles and velocities of the full chain."""
        snapshots = np.array([unfold(part, cut) for part in record.snapshots])
        return {
            # not the angles: they depend on the phase at the snapshot, which all pendula share
            "modulus": swings_of(*snapshots, self.constants.omega, self.mu),
            "final": np.array([unfold(y[part::2, 1:-1], cut) for part in (0, 1)]),
            "state": snapshots,
        }
