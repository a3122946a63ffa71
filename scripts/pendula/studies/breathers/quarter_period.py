"""The flow of (4) and of its small perturbations over a quarter of a period, by fixed steps.

The steps are those of the method of order eight, DOP853. A fixed number of them makes the map from
initial to final state smooth, as Newton's method requires: controlled steps would depend on the
data.
"""

import numpy as np
from latticode.equations.ends import DIRICHLET
from latticode.generation.chain import MIRROR, close
from latticode.integrators.dop853 import combine
from latticode.kernels.compiled import copy, kernel
from latticode.simulation.lattice import aligned

from pendula.models.amplitudes import AmplitudeChain, rates, write_tangent_rates
from pendula.problem import Constants

STEPS, FINE_STEPS = 16, 40
"""Steps in a quarter of a period. Multipliers keep 10 digits if the smaller number is doubled. With
the larger number, a solution returns after a period to within 1e-11."""
STAGES, SLOPES = 13, 16
ROWS = 4
"""Rows of one state: Re A, Im A, Re B, Im B."""


@kernel
def parity_rates(chain: AmplitudeChain, bundle: np.ndarray, even: int, slopes: np.ndarray) -> None:
    """Write the rates of a solution, of its `even` even perturbations, and of its odd ones.

    All are on the sites 0..M. Site -1 mirrors site 1, with the same sign in an even state and the
    opposite sign in an odd state, which stays zero at site 0.
    """
    y = bundle[:ROWS]
    rates(chain, y, slopes[:ROWS])
    for first in range(ROWS, bundle.shape[0], ROWS):
        w = bundle[first : first + ROWS]
        close(chain, w)
        if first > ROWS * even:
            for row in range(ROWS):
                w[row, 0] = -w[row, 2]
        write_tangent_rates(chain, (y, w), slopes[first : first + ROWS])


@kernel
def advance_bundle(
    chain: AmplitudeChain,
    bundle: np.ndarray,
    even: int,
    duration: float,
    steps: int,
    work: np.ndarray,
) -> None:
    """Advance a bundle over `duration` in equal steps; `work` holds SLOPES + 1 bundles."""
    h = duration / steps
    y, k, w = bundle.reshape(-1), work[:SLOPES].reshape(SLOPES, -1), work[SLOPES]
    for _ in range(steps):
        parity_rates(chain, bundle, even, work[0])
        for stage in range(2, STAGES + 1):
            combine(stage, y, h, k, w.reshape(-1))
            if stage < STAGES:
                parity_rates(chain, w, even, work[stage - 1])
        copy(w, bundle)


def integrate_bundle(
    constants: Constants,
    state: np.ndarray,
    evens: np.ndarray,
    odds: np.ndarray,
    duration: float,
    steps: int,
) -> np.ndarray:
    """Return a state and its perturbations after `duration`, (1 + vectors, 4, M + 1).

    `state` is (4, M + 1): Re A, Im A, Re B, Im B on the sites 0..M of an even chain at rest beyond
    its ends. `evens` and `odds` are (vector, 4, M + 1); odd vectors are zero at site 0. The result
    has the state first, then the even vectors, then the odd ones.
    """
    chain = AmplitudeChain(constants.epsilon, constants.gamma, constants.omega, MIRROR, DIRICHLET)
    states = np.concatenate([state[None], evens, odds])
    bundle = aligned((ROWS * len(states), states.shape[2] + 2))
    bundle[:] = 0.0
    bundle[:, 1:-1] = states.reshape(-1, states.shape[2])
    work = aligned((SLOPES + 1, *bundle.shape))
    work[:] = 0.0
    advance_bundle(chain, bundle, len(evens), duration, steps, work)
    return bundle[:, 1:-1].reshape(states.shape).copy()
