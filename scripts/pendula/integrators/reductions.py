"""The largest of many numbers, in a form that the processor's vector units can take."""

import numpy as np

from pendula.compiled import kernel

MAGNITUDE = 0x7FFF_FFFF_FFFF_FFFF
"""The bits of a double but for its sign."""


@kernel
def largest(values):
    """Return the largest absolute value, NaN counting as larger than infinity.

    The bits of doubles without their sign, read as integers, are in the order of the numbers, and
    NaN comes last; unlike floating-point comparisons, those of integers may be reordered and so
    vectorised. `values` is contiguous scratch space: its first element is overwritten.
    """
    bits = values.view(np.int64)
    top = np.int64(0)
    for i in range(bits.size):
        top = max(top, bits[i] & MAGNITUDE)
    bits[0] = top
    return values[0]


@kernel
def largest_of_rows(scratch, rows):
    """Return the largest of the first `rows` rows of a state-shaped array but for its ghosts."""
    columns = scratch.shape[1]
    for row in range(rows):
        scratch[row, 0] = scratch[row, columns - 1] = 0.0
    return largest(scratch.reshape(-1)[: rows * columns])
