"""What a run keeps at each output time: norms, energy if there is one, and the chain on request."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.compiled import inlined_by_llvm, kernel
from pendula.models.amplitudes import energy_with_scratch, modulus2
from pendula.models.chain import MIRROR


class Record(NamedTuple):
    """The arrays that a run fills while it integrates; `every` = 0 keeps no moduli."""

    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # (time,)
    modulus: np.ndarray  # (component, site, snapshot)
    every: int
    scratch: np.ndarray  # (2, column), for the energy


def blank_record(components: int, sites: int, times: int, every: int) -> Record:
    """Return empty arrays for a run of `times` outputs, with moduli at each `every`-th of them."""
    snapshots = (times - 1) // every + 1 if every else 0
    return Record(
        np.empty((components, times)),
        np.empty((components, times)),
        np.empty(times),
        np.empty((components, sites, snapshots)),
        every,
        np.empty((2, sites + 2)),
    )


def norms_by(square):
    """Return the function that reduces a component to its norms; square(y, row, j) is |A_n|^2."""

    @inlined_by_llvm
    def norms(chain, y, row):
        """Return the l-infinity and l2 norms of one component over the whole chain."""
        mirrored = chain.left == MIRROR
        sites = y.shape[1] - 2
        reach = sites - 1 if mirrored else sites // 2
        centre = 1 if mirrored else 1 + reach
        side = 1 if mirrored else -1
        total = largest = square(y, row, centre)
        for n in range(1, reach + 1):
            right = square(y, row, centre + n)
            left = square(y, row, centre + side * n)
            total += right + left
            largest = max(largest, right, left)
        return sqrt(largest), sqrt(total)

    return norms


norms_of_amplitudes = norms_by(modulus2)


@kernel
def norms(chain, y, re):
    """Return the l-infinity and l2 norms of A or B over the whole chain."""
    return norms_of_amplitudes(chain, y, re)


@kernel
def observe(chain, y, i, record):
    """Reduce the state `y` to the observables of output `i`."""
    for k in range(y.shape[0] // 2):
        record.linf[k, i], record.l2[k, i] = norms(chain, y, 2 * k)
        if record.every > 0 and i % record.every == 0:
            for j in range(1, y.shape[1] - 1):
                record.modulus[k, j - 1, i // record.every] = sqrt(modulus2(y, 2 * k, j))
    record.energy[i] = energy_with_scratch(chain, y, record.scratch)


# --- Of the pendula -----------------------------------------------------------------------------


class AngleRecord(NamedTuple):
    """The arrays that a run of the pendula fills; `every` = 0 keeps no snapshots."""

    linf: np.ndarray  # (component, time), of the angles
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # empty: what is driven conserves none
    snapshots: np.ndarray  # (part, component, site, snapshot), angles and velocities
    every: int


def blank_angle_record(components: int, sites: int, times: int, every: int) -> AngleRecord:
    """Return empty arrays for a run of `times` outputs, with snapshots at each `every`-th."""
    snapshots = (times - 1) // every + 1 if every else 0
    return AngleRecord(
        np.empty((components, times)),
        np.empty((components, times)),
        np.empty(0),
        np.empty((2, components, sites, snapshots)),
        every,
    )


@inlined_by_llvm
def square_of_angle(y, row, j):
    return y[row, j] * y[row, j]


norms_of_angles = norms_by(square_of_angle)


@kernel
def observe_angles(pendula, y, i, record):
    """Reduce the state `y` of the pendula to the observables of output `i`."""
    for k in range(y.shape[0] // 2):
        record.linf[k, i], record.l2[k, i] = norms_of_angles(pendula, y, 2 * k)
        if record.every > 0 and i % record.every == 0:
            for part in range(2):
                for j in range(1, y.shape[1] - 1):
                    record.snapshots[part, k, j - 1, i // record.every] = y[2 * k + part, j]
