"""What a run keeps at each output time: norms, what is conserved, and the chain on request."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from latticode.generation.chain import MIRROR, modulus2
from latticode.kernels.compiled import inlined_by_llvm, uncached
from latticode.kernels.simd import largest_magnitude


class ObservableRecord(NamedTuple):
    """The arrays that a run fills while it integrates; `every` = 0 keeps no snapshots."""

    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    # moduli (component, site, snapshot), or states (part, component, site, snapshot)
    snapshots: np.ndarray
    every: int
    scratch: np.ndarray  # (component, column), two rows at least
    conserved: np.ndarray  # (quantity, time), empty if no run asks for it


def blank_record(
    components: int, sites: int, times: int, every: int, quantities: int = 0, parts: int = 0
) -> ObservableRecord:
    """Return empty arrays for a run of `times` outputs, with snapshots at each `every`-th of them.

    Snapshots are moduli, or states of so many `parts`. Conserved `quantities` may take half of the
    time of an output; a run whose norms alone are wanted asks for none.
    """
    count = (times - 1) // every + 1 if every else 0
    moduli_shape = (components, sites, count)
    return ObservableRecord(
        np.empty((components, times)),
        np.empty((components, times)),
        np.empty((parts, *moduli_shape) if parts else moduli_shape),
        every,
        np.empty((max(2, components), sites + 2)),
        np.empty((quantities, times)),
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
        if a.size % 2 == 0:  # of an even number of sites the last has no partner
            of_a, of_b = of_a + a[a.size - 2], of_b + b[a.size - 2]
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
        for row in range(0, last + 1, 2):
            next_row = min(row + 1, last)  # the same one twice where there is no other
            sum_of_one, sum_of_other = sums_over_chain(chain, squares[row], squares[next_row])
            record.l2[row, i], record.l2[next_row, i] = sqrt(sum_of_one), sqrt(sum_of_other)
        for k in range(last + 1):
            record.linf[k, i] = sqrt(largest_magnitude(squares[k, 1:-1]))

    return write_norms


def observer(square, keep_site):
    """Return what keeps norms, and snapshots by keep_site(y, component, column, snapshot, kept)."""
    write_norms = norms_by(square)

    @uncached
    def observe(system, y, i, record):
        """Reduce the state `y` to the observables of output `i`."""
        write_norms(system, y, i, record)
        if record.every > 0 and i % record.every == 0:
            for k in range(y.shape[0] // 2):
                for j in range(1, y.shape[1] - 1):
                    keep_site(y, k, j, i // record.every, record.snapshots)

    return observe


@inlined_by_llvm
def keep_modulus(y, k, j, snapshot, snapshots):
    """Keep the modulus, or both parts where `snapshots` has room for them."""
    if snapshots.ndim == 4:  # numba compiles one of the two
        for row in range(2):
            snapshots[row, k, j - 1, snapshot] = y[2 * k + row, j]
    else:
        snapshots[k, j - 1, snapshot] = sqrt(modulus2(y, 2 * k, j))


@inlined_by_llvm
def keep_parts(y, k, j, snapshot, snapshots):
    for row in range(2):
        snapshots[row, k, j - 1, snapshot] = y[2 * k + row, j]


@inlined_by_llvm
def square_of_angle(y, row, j):
    return y[row, j] * y[row, j]


observe_moduli = observer(modulus2, keep_modulus)
observe_angles = observer(square_of_angle, keep_parts)
observe_fields = observer(modulus2, keep_parts)
