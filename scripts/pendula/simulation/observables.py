"""What a run keeps at each output time: norms, energy if there is one, and the chain on request."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.compiled import inlined_by_llvm, kernel
from pendula.models.amplitudes import energy_with_scratch, modulus2
from pendula.models.chain import MIRROR
from pendula.simd import largest_magnitude


class Record(NamedTuple):
    """The arrays that a run fills while it integrates; `every` = 0 keeps no moduli."""

    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # (time,), or empty where it is not asked for
    modulus: np.ndarray  # (component, site, snapshot)
    every: int
    scratch: np.ndarray  # (2, column)


def blank_record(
    components: int, sites: int, times: int, every: int, energy: bool = True
) -> Record:
    """Return empty arrays for a run of `times` outputs, with moduli at each `every`-th of them.

    The energy takes half of the time that an output takes; who asks for norms alone may leave it.
    """
    snapshots = (times - 1) // every + 1 if every else 0
    return Record(
        np.empty((components, times)),
        np.empty((components, times)),
        np.empty(times if energy else 0),
        np.empty((components, sites, snapshots)),
        every,
        np.empty((2, sites + 2)),
    )


@inlined_by_llvm
def sums_over_chain(chain, a, b):
    """Return the sums of two rows (column,) over the sites of the whole chain.

    They go from the centre outwards in pairs of sites, so that half a chain gives the bits of the
    whole, and side by side, since each addition waits for the one before it.
    """
    mirrored = chain.left == MIRROR
    reach = a.size - 3 if mirrored else (a.size - 3) // 2
    centre = 1 if mirrored else 1 + reach
    of_a, of_b = a[centre], b[centre]
    if mirrored:
        for j in range(centre + 1, centre + reach + 1):
            of_a, of_b = of_a + (a[j] + a[j]), of_b + (b[j] + b[j])
    else:
        for n in range(1, reach + 1):
            right, left = centre + n, centre - n
            of_a, of_b = of_a + (a[right] + a[left]), of_b + (b[right] + b[left])
    return of_a, of_b


def norms_by(square):
    """Return the function that writes the norms of a state; square(y, row, j) is |A_n|^2."""

    @inlined_by_llvm
    def write_norms(chain, y, i, record):
        """Write the l-infinity and l2 norms of each component over the whole chain."""
        squares, last = record.scratch, y.shape[0] // 2 - 1
        for k in range(last + 1):
            for j in range(1, y.shape[1] - 1):
                squares[k, j] = square(y, 2 * k, j)
        # the same one twice where one component stands for both
        first_sum, last_sum = sums_over_chain(chain, squares[0], squares[last])
        record.l2[0, i], record.l2[last, i] = sqrt(first_sum), sqrt(last_sum)
        for k in range(last + 1):
            record.linf[k, i] = sqrt(largest_magnitude(squares[k, 1:-1]))

    return write_norms


write_norms_of_amplitudes = norms_by(modulus2)


@kernel
def observe(chain, y, i, record):
    """Reduce the state `y` to the observables of output `i`."""
    write_norms_of_amplitudes(chain, y, i, record)
    if record.every > 0 and i % record.every == 0:
        for k in range(y.shape[0] // 2):
            for j in range(1, y.shape[1] - 1):
                record.modulus[k, j - 1, i // record.every] = sqrt(modulus2(y, 2 * k, j))
    if record.energy.size > 0:
        record.energy[i] = energy_with_scratch(chain, y, record.scratch)


# --- Of the pendula -----------------------------------------------------------------------------


class AngleRecord(NamedTuple):
    """The arrays that a run of the pendula fills; `every` = 0 keeps no snapshots."""

    linf: np.ndarray  # (component, time), of the angles
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # empty: what is driven conserves none
    snapshots: np.ndarray  # (part, component, site, snapshot), angles and velocities
    every: int
    scratch: np.ndarray  # (2, column)


def blank_angle_record(
    components: int, sites: int, times: int, every: int, energy: bool = False
) -> AngleRecord:
    """Return empty arrays for a run of `times` outputs, with snapshots at each `every`-th."""
    snapshots = (times - 1) // every + 1 if every else 0
    return AngleRecord(
        np.empty((components, times)),
        np.empty((components, times)),
        np.empty(0),
        np.empty((2, components, sites, snapshots)),
        every,
        np.empty((2, sites + 2)),
    )


@inlined_by_llvm
def square_of_angle(y, row, j):
    return y[row, j] * y[row, j]


write_norms_of_angles = norms_by(square_of_angle)


@kernel
def observe_angles(pendula, y, i, record):
    """Reduce the state `y` of the pendula to the observables of output `i`."""
    write_norms_of_angles(pendula, y, i, record)
    if record.every > 0 and i % record.every == 0:
        for k in range(y.shape[0] // 2):
            for part in range(2):
                for j in range(1, y.shape[1] - 1):
                    record.snapshots[part, k, j - 1, i // record.every] = y[2 * k + part, j]
