"""Observables at each output time: norms, conserved quantities, and snapshots of the chain."""

from collections.abc import Callable
from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from latticode.generation.chain import MIRROR, modulus2
from latticode.kernels.compiled import in_one_pass, inlined_by_llvm, uncached
from latticode.kernels.simd import largest_magnitude


class ObservableRecord(NamedTuple):
    """Arrays that a run fills; it stores no snapshots if `every` is 0."""

    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    # moduli (component, site, snapshot), or states (part, component, site, snapshot)
    snapshots: np.ndarray
    every: int
    scratch: np.ndarray  # (component, column), at least two rows
    conserved: np.ndarray  # (quantity, time), empty unless requested


def blank_record(
    components: int, sites: int, times: int, every: int, quantities: int = 0, parts: int = 0
) -> ObservableRecord:
    """Return uninitialised arrays for `times` outputs, with a snapshot at every `every`-th output.

    Snapshots are moduli if `parts` is 0, otherwise states. `quantities` is the number of conserved
    quantities: computing them may take half of the time of an output.
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
def sums_over_chain(chain: Any, a: np.ndarray, b: np.ndarray) -> tuple[float, float]:
    """Return the sums of two rows (column,) over the sites of the whole chain.

    Pairs of sites are added from the centre outwards, so that half of an even chain gives the same
    bits. Both sums run in parallel, because each addition must wait for the previous one.
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
        if a.size % 2 == 0:  # an even number of sites leaves the last one without a partner
            of_a, of_b = of_a + a[a.size - 2], of_b + b[a.size - 2]
    return of_a, of_b


def norms_by(square: Callable) -> Callable:
    """Return the kernel that writes norms; square(y, row, j) returns |A|^2 of a field."""

    @in_one_pass
    def write_norms(chain: Any, y: np.ndarray, i: int, record: ObservableRecord) -> None:
        """Write the l-infinity and l2 norms of each component over the whole chain."""
        squares, last = record.scratch, y.shape[0] // 2 - 1
        for k in range(last + 1):
            for j in range(1, y.shape[1] - 1):
                squares[k, j] = square(y, 2 * k, j)
        for row in range(0, last + 1, 2):
            next_row = min(row + 1, last)  # a single component is summed twice
            first, second = sums_over_chain(chain, squares[row], squares[next_row])
            record.l2[row, i], record.l2[next_row, i] = sqrt(first), sqrt(second)
        for k in range(last + 1):
            record.linf[k, i] = sqrt(largest_magnitude(squares[k, 1:-1]))

    return write_norms


def observer(square: Callable, keep_site: Callable) -> Callable:
    """Return the kernel that stores norms, and calls `keep_site` for each site of a snapshot."""
    write_norms = norms_by(square)

    @in_one_pass
    def write(system: Any, y: np.ndarray, i: int, record: ObservableRecord) -> None:
        """Write the observables of the state `y` at output `i`."""
        write_norms(system, y, i, record)
        if record.every > 0 and i % record.every == 0:
            for k in range(y.shape[0] // 2):
                for j in range(1, y.shape[1] - 1):
                    keep_site(y, k, j, i // record.every, record.snapshots)

    @uncached
    def observe(system: Any, y: np.ndarray, i: int, record: ObservableRecord) -> None:
        write(system, y, i, record)

    return observe


@inlined_by_llvm
def keep_modulus(y: np.ndarray, k: int, j: int, snapshot: int, snapshots: np.ndarray) -> None:
    """Store the modulus of a component, or both its parts if `snapshots` has four dimensions."""
    if snapshots.ndim == 4:  # numba compiles only the branch that applies
        for row in range(2):
            snapshots[row, k, j - 1, snapshot] = y[2 * k + row, j]
    else:
        snapshots[k, j - 1, snapshot] = sqrt(modulus2(y, 2 * k, j))


@inlined_by_llvm
def keep_parts(y: np.ndarray, k: int, j: int, snapshot: int, snapshots: np.ndarray) -> None:
    """Store both parts of a component."""
    for row in range(2):
        snapshots[row, k, j - 1, snapshot] = y[2 * k + row, j]


@inlined_by_llvm
def square_of_angle(y: np.ndarray, row: int, j: int) -> float:
    """Return the square of a real field, such as the angle of a pendulum."""
    return y[row, j] * y[row, j]


observe_moduli = observer(modulus2, keep_modulus)
observe_angles = observer(square_of_angle, keep_parts)
observe_fields = observer(modulus2, keep_parts)
