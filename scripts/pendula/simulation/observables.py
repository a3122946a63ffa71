"""The observables that a run keeps at each output time: norms, energy, and moduli on request."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.models.amplitudes import MIRROR, energy_with_scratch, modulus2


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


@kernel
def norms(chain, y, re):
    """Return the l-infinity and l2 norms of one component over the whole chain."""
    mirrored = chain.left == MIRROR
    sites = y.shape[1] - 2
    reach = sites - 1 if mirrored else sites // 2
    centre = 1 if mirrored else 1 + reach
    side = 1 if mirrored else -1
    total = largest = modulus2(y, re, centre)
    for n in range(1, reach + 1):
        right = modulus2(y, re, centre + n)
        left = modulus2(y, re, centre + side * n)
        total += right + left
        largest = max(largest, right, left)
    return sqrt(largest), sqrt(total)


@kernel
def observe(chain, y, i, record):
    """Reduce the state `y` to the observables of output `i`."""
    for k in range(y.shape[0] // 2):
        record.linf[k, i], record.l2[k, i] = norms(chain, y, 2 * k)
        if record.every > 0 and i % record.every == 0:
            for j in range(1, y.shape[1] - 1):
                record.modulus[k, j - 1, i // record.every] = sqrt(modulus2(y, 2 * k, j))
    record.energy[i] = energy_with_scratch(chain, y, record.scratch)
