"""Many independent short runs of chains of equal size in one compiled call.

One call from Python per run would cost as much as the run for a few sites.
"""

import numpy as np

from ..chain import ENDS, Chain
from ..compiled import copy, kernel
from ..integrators import dop853
from ..integrators.outcome import DONE
from ..lattice import pack
from ..observables import blank_record
from ..solvers import run_dop853
from .runs import FULL, QUICK


@kernel
def run_batch(constants, ends, states, times, controls, work, record, powers, energies):
    """Integrate each of `states` (run, row, column); write P at all times and H at the start.

    `constants` is (run, 3), `ends` (run,); all runs share `work` and `record`. A run that its
    solver gives up has an infinite P from then on.
    """
    y = np.empty((states.shape[1], states.shape[2]))
    for i in range(states.shape[0]):
        chain = Chain(constants[i, 0], constants[i, 1], constants[i, 2], ends[i], ends[i])
        copy(states[i], y)
        outcome = run_dop853(chain, y, times, controls, work, record)
        energies[i] = record.energy[0]
        for t in range(times.size):
            a, b = record.l2[0, t], record.l2[1, t]
            reached = outcome.status == DONE or times[t] <= outcome.time
            powers[i, t] = a * a + b * b if reached else np.inf


def run_powers(constants, boundaries, amplitudes, times, solver=QUICK):
    """Return P = |A|^2 + |B|^2 of each run at each time, (run, time), and H of each, (run,).

    `constants` is a list of (epsilon, gamma, Omega), `boundaries` of names, `amplitudes` of
    arrays (2, N) with one N for all runs.
    """
    states = np.array([pack(pair, FULL) for pair in amplitudes])
    constants = np.array(constants, float).reshape(-1, 3)
    ends = np.array([ENDS[name] for name in boundaries])
    times = np.asarray(times, float)
    powers, energies = np.empty((len(states), len(times))), np.empty(len(states))
    record = blank_record(2, states.shape[2] - 2, len(times), 0)
    work = np.zeros((dop853.WORK, *states.shape[1:]))
    controls = (float(solver["rtol"]), float(solver["atol"]))
    run_batch(constants, ends, states, times, controls, work, record, powers, energies)
    return powers, energies
