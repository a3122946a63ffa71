"""Many independent short runs of chains of equal size: the theory's random data."""

import numpy as np

from pendula.integrators.outcome import DONE
from pendula.simulation.batches import integrate_batch

from .runs import TOLERANCES, squared_norm


def run_powers(constants, boundaries, amplitudes, times, tolerances=TOLERANCES):
    """Return P = |A|^2 + |B|^2 of each run at each time, (run, time), and H of each, (run,).

    `constants` is a list of (epsilon, gamma, Omega), `boundaries` of names, `amplitudes` of
    arrays (2, N) with one N for all runs. A run that its solver gives up has an infinite P from
    then on.
    """
    constants, amplitudes, boundaries = map(np.asarray, (constants, amplitudes, boundaries))
    times = np.asarray(times, float)
    powers, energies = np.empty((len(amplitudes), len(times))), np.empty(len(amplitudes))
    for boundary in np.unique(boundaries):
        of = boundaries == boundary
        batch = integrate_batch(constants[of], boundary, amplitudes[of], times, **tolerances)
        lost = (batch.ended["status"] != DONE)[:, None] & (times > batch.ended["time"][:, None])
        powers[of] = squared_norm(np.where(lost, np.inf, batch.l2))
        energies[of] = batch.energy[:, 0]
    return powers, energies
