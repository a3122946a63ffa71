"""What is checked of a model of a user's own: growth of small errors, and conserved quantities."""

from functools import partial

import numpy as np
import xarray as xr

from pendula.datasets.checks import table, variable
from pendula.integrators import DONE, FAULTS
from pendula.numerics.elementary import log
from pendula.problem import Problem, output_times
from pendula.simulation.interrupts import interruptible
from pendula.simulation.lattice import WHOLE
from pendula.simulation.models import model_of
from pendula.simulation.simulate import IntegrationError
from pendula.studies.chaos.tangent_dynamics import STEP, TOLERANCE, Growth

FEWEST_STEPS, SEED = 64, 20170817


def follow_own(problem: Problem) -> Growth:
    """Return the growth of a random small perturbation, by the derivative of the traced equations.

    It is integrated beside the solution and made of unit length again at equal steps. Raises
    IntegrationError where dop853 gives up.
    """
    shape = problem.amplitudes.shape
    drawn = np.random.default_rng(SEED).normal(size=(2, *shape))
    both = np.concatenate([problem.amplitudes, drawn[0] + 1j * drawn[1]])
    solver = {"name": "dop853", "rtol": TOLERANCE, "atol": TOLERANCE}
    tangent = problem.model.tangent()
    twin = problem.changed(model=tangent, initial=both, snapshot_every=0, solver=solver)
    model = model_of(twin)
    system, y, method = model.system(twin, WHOLE), model.start(twin, WHOLE), model.solvers["dop853"]
    tau = output_times(problem.end_time, min(STEP, problem.end_time / FEWEST_STEPS))
    work, record = method.room_for(system, y), model.record(len(both), shape[1], 2, 0)
    run = partial(interruptible, method.run, system, y)
    solution, change = y[: 2 * shape[0]], y[2 * shape[0] :]
    lengths, sizes = np.ones(tau.size), np.empty(tau.size)
    for i in range(tau.size):
        if i > 0:
            outcome = run(tau[i - 1 : i + 1], (TOLERANCE, TOLERANCE), work, record)
            if outcome.status != DONE:
                raise IntegrationError(f"it could not be followed: {FAULTS[outcome.status]}")
        length = np.sqrt(np.sum(change[:, 1:-1] ** 2))
        lengths[i] = length if i > 0 else 1.0
        change /= length
        sizes[i] = np.sqrt(np.sum(solution[:, 1:-1] ** 2))
    return Growth(tau, log(lengths).cumsum()[None], sizes)


def check_conserved(run: xr.Dataset, title: str) -> xr.Dataset:
    """Return by how much each conserved quantity drifts, relative to its largest size."""
    if "conserved" not in run:
        return xr.Dataset()
    values = run["conserved"].values
    drift = np.abs(values - values[:, :1]).max(axis=1)
    sizes = np.abs(values).max(axis=1)
    drift = np.where(sizes > 0, drift / np.where(sizes > 0, sizes, 1.0), 0.0)
    about = "largest change of a conserved quantity, relative to its largest size"
    names = {"conserved_quantity": run["conserved_quantity"].values}
    described = variable(drift, ("conserved_quantity",), about)
    return xr.Dataset.from_dict(table(title, names, conserved_drift=described))
