"""Runs of the chain by one integrator, from numbers and data."""

import numpy as np
from latticode.simulation.lattice import Reduction
from latticode.simulation.simulate import Trajectory, simulate
from oracle import CASES
from problems import make_problem

WHOLE = Reduction(even=False, synchronised=False)


def integrate(z, solver, end=1.0, outputs=1, reduction=WHOLE, **changes) -> Trajectory:
    """Integrate data (2, N) to `end` with so many outputs after the first; see `make_problem`."""
    times = {"end_time": float(end), "output_step": float(end) / outputs}
    return simulate(make_problem(z, solver=solver, **times, **changes), reduction)


def data_of(case, half_width=30):
    """Return the data (2, N) of a case of the paper."""
    z = np.zeros((2, 2 * half_width + 1), complex)
    z[:, half_width] = CASES[case][1]
    return z


def numbers_of(case):
    """Return epsilon, gamma and Omega of a case of the paper."""
    return 1.0, 1.0, CASES[case][0]
