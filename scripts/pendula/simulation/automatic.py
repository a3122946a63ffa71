"""A tolerance picked by the error that is asked for, and held to it by a second run.

No tolerance promises an error, least of all where the motion is chaotic. So the run is repeated
at a hundredth of the tolerance until two in a row agree as closely as was asked; the finer one is
returned. The solver is the one that was the fastest at every error that was measured (see the
figures of speed against error).
"""

from collections.abc import Callable

import numpy as np

FINEST, REFINEMENT = 1e-15, 1e-2


def controls(tolerance: float) -> dict:
    """Return the fastest solver at this tolerance."""
    return {"name": "taylor", "rtol": tolerance, "atol": tolerance}


def refine(run: Callable[[dict], tuple], error: float):
    """Return (trajectory, its controls, the estimated error) of the first run that is good enough.

    `run` makes a trajectory of a solver's controls. Raises ArithmeticError where double precision
    has not that many digits, naming the time up to which it had.
    """
    tolerance = min(error, 1e-4)
    coarse = run(controls(tolerance))
    while tolerance > FINEST:
        tolerance = max(REFINEMENT * tolerance, FINEST)
        fine = run(controls(tolerance))
        differences = difference(coarse, fine)
        if differences.max() <= error:
            return fine, controls(tolerance), float(differences.max())
        coarse = fine
    lost = fine.tau[np.argmax(differences > error)]
    raise ArithmeticError(
        f"runs in double precision agree to {error:g} only before tau = {lost:g}: "
        "end the run earlier, or ask for a larger error"
    )


def difference(one, other) -> np.ndarray:
    """Return by how much two trajectories differ in any norm at each time, of its largest value."""
    pairs = ((one.linf, other.linf), (one.l2, other.l2))
    return np.max([np.max(np.abs(a - b), axis=0) / np.max(b) for a, b in pairs], axis=0)
