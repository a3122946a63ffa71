"""Two runs of a case that share no rounding: what they agree on is the solution's."""

from typing import NamedTuple

import numpy as np

from .run import Run

LIMIT = 1e-12
"""The largest difference of any norm that two runs may have, at any output time."""


class UnverifiedError(RuntimeError):
    """Two multiprecision runs that part: neither has digits enough."""


class Discrepancy(NamedTuple):
    """How far two runs of a case are apart, in doubles."""

    norms: np.ndarray  # (time,), the largest over both norms and components
    amplitude: np.ndarray  # (snapshot,), the largest over parts, components and sites
    energy_drift: float  # max |H - H(0)| of the first run


def compare(run: Run, check: Run) -> Discrepancy:
    """Return how far two runs are apart, the difference taken before any rounding to double."""
    linf, l2 = np.abs(run.linf - check.linf), np.abs(run.l2 - check.l2)
    apart = np.maximum(np.maximum.reduce(linf), np.maximum.reduce(l2))
    amplitude = np.maximum.reduce(np.abs(run.amplitude - check.amplitude), axis=(1, 2))
    drift = np.maximum.reduce(np.abs(run.energy - run.energy[0]))
    return Discrepancy(apart.astype(float), amplitude.astype(float), float(drift))


def require_agreement(name: str, run: Run, check: Run, discrepancy: Discrepancy) -> None:
    """Raise UnverifiedError where a norm of the two runs differs by LIMIT or more."""
    parted = np.flatnonzero(~(discrepancy.norms < LIMIT))
    if parted.size:
        raise UnverifiedError(
            f"{name}: runs of {run.bits} and {check.bits} bits differ by {LIMIT:g} or more "
            f"from tau = {run.tau[parted[0]]:g} on; give the case more bits"
        )
