"""Thresholds below which numbers in a state are set to zero, to avoid slow subnormal arithmetic.

Ahead of a front the fields fall off to 1e-150 and below, and their squares and cubes are subnormal
or vanish. Many processors handle subnormal numbers in microcode, which would slow down a long chain
with one excited site several times. Every solver therefore sets numbers in a state that are below
`rest_level` to zero, and products of fields treat factors below TINY as zero.

Products of such factors are too small to change the last bit of a linear term. Numbers set to zero
change neighbouring sites by less than a last bit. Like any such change, this may eventually change
the rounding at a larger neighbour.

The processor's mode that flushes subnormals is not used: WebAssembly has no such mode, and aarch64
and x86 flush at different stages. The results must have the same bits everywhere.
"""

import numpy as np

from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.kernels.simd import TINY, zero_below

OF_SERIES, OF_STAGES = 1e-130, 1e-250
"""Thresholds for states of power series and of Runge-Kutta stages. Series multiply coefficients
without a check. The rates in stages compare factors with TINY, so smaller numbers are harmless."""
RESOLVED = 1e-60
"""This factor times the largest number of a state is the threshold if the product is smaller."""


@kernel
def rest_level(y: np.ndarray, level: float) -> float:
    """Return the threshold below which numbers become zero in a run from the state `y`.

    It is `level`, or RESOLVED times the largest number in `y` if this product is smaller.
    """
    largest = 0.0
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            largest = max(largest, abs(y[row, j]))
    return min(level, RESOLVED * largest) if largest > 0.0 else level


@kernel
def set_to_rest(y: np.ndarray, level: float) -> None:
    """Set the numbers of a state (row, column) below `level` to zero."""
    for row in range(y.shape[0]):
        for j in range(y.shape[1]):
            y[row, j] = zero_below(level, y[row, j])


@inlined_by_llvm
def square_modulus(y: np.ndarray, re: int, j: int) -> float:
    """Return the squared modulus at column `j` of the component with real parts in row `re`.

    Real and imaginary parts below TINY count as zero, because their squares would be subnormal.
    """
    real, imaginary = zero_below(TINY, y[re, j]), zero_below(TINY, y[re + 1, j])
    return real * real + imaginary * imaginary
