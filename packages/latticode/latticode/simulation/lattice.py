"""Conversion of complex amplitudes on the sites -M..M to the state of a run, and back.

For data even in n the state has only the sites 0..M; for A = B it has only A. The equations
conserve both symmetries, and the kernels conserve them to the last bit.
"""

from math import prod
from typing import NamedTuple

import numpy as np

from latticode.equations.ends import FREE, MIRROR, PERIODIC, kind_of

CACHE_LINE = 64
"""Bytes in a cache line."""


class Reduction(NamedTuple):
    """The part that is integrated: half of the chain if `even`, one component if `synchronised`."""

    even: bool
    synchronised: bool


FULL_CHAIN = Reduction(even=False, synchronised=False)
"""Both components on the whole chain, without use of symmetries."""


def find_reduction(amplitudes: np.ndarray) -> Reduction:
    """Return the reduction that the exact symmetries of amplitudes (component, site) allow."""
    return Reduction(
        even=amplitudes.shape[1] > 1 and bool((amplitudes == amplitudes[:, ::-1]).all()),
        synchronised=bool((amplitudes[0] == amplitudes[-1]).all()),
    )


def choose_ends(boundary: str, reduction: Reduction) -> tuple[int, int]:
    """Return the kinds of the left and right ends of the integrated part of the chain."""
    end = kind_of(boundary)
    if not reduction.even:
        return end, end
    # an even solution on a ring has A_{M+1} = A_{-M} = A_M, as at a free end
    return MIRROR, FREE if end == PERIODIC else end


def pack(amplitudes: np.ndarray, reduction: Reduction) -> np.ndarray:
    """Return amplitudes (component, site) as a reduced real state (row, column) with ghosts."""
    fields = amplitudes[:1] if reduction.synchronised else amplitudes
    if reduction.even:
        fields = fields[:, fields.shape[1] // 2 :]
    y = np.zeros((2 * len(fields), fields.shape[1] + 2))
    y[0::2, 1:-1] = fields.real
    y[1::2, 1:-1] = fields.imag
    return y


def unfold(values: np.ndarray, reduction: Reduction) -> np.ndarray:
    """Return reduced values (component, site, ...) on all components and the whole chain."""
    if reduction.even:
        values = np.concatenate([values[:, :0:-1], values], axis=1)
    return np.repeat(values, 2, axis=0) if reduction.synchronised else values


def unpack(y: np.ndarray, reduction: Reduction) -> np.ndarray:
    """Return the complex amplitudes (component, site) of a reduced state on the whole chain."""
    return unfold(y[0::2, 1:-1] + 1j * y[1::2, 1:-1], reduction)


def aligned(shape: tuple[int, ...]) -> np.ndarray:
    """Return zeros aligned to a cache line, because loads that cross lines cost 25 % more."""
    count = prod(shape)
    memory = np.zeros(count + CACHE_LINE // 8)
    first = -memory.__array_interface__["data"][0] % CACHE_LINE // 8
    return memory[first : first + count].reshape(shape)
