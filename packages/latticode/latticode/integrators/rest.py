"""What counts as rest: numbers so small that no run computes with them.

Where motion has yet to arrive, the fields fall off to 1e-150 and less, and their squares and cubes
are subnormal numbers or vanish. Many processors take each of these by microcode, and a long chain
with one excited site would take several times as long for them. So every solver sets numbers in a
state that are below `rest_level` to zero, and products of fields take factors below TINY as zero.

A product of such factors is too small to change the last bit of a linear term. What is set to zero
in a state is missing in its neighbours, by less than their last bits. Like any change of last bits
it can turn a rounding of a larger neighbour after a while, and that of the next one.

Numbers are compared, and no mode of the processor is switched: WebAssembly has none, aarch64 and
x86 flush at different places, and results are to have the same bits everywhere.
"""

from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.kernels.simd import TINY, zero_below

OF_SERIES, OF_STAGES = 1e-130, 1e-250
"""The least numbers in states. A power series multiplies its coefficients as they are; in stages of
a step factors are compared with TINY, and what sums make of states is still a normal number."""
RESOLVED = 1e-60
"""Of smaller data, numbers count down to this part of the largest of them."""


@kernel
def rest_level(y, level):
    """Return the size below which numbers are rest in a run that starts from the state `y`.

    It is `level` or, for tiny data, less.
    """
    largest = 0.0
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            largest = max(largest, abs(y[row, j]))
    return min(level, RESOLVED * largest) if largest > 0.0 else level


@kernel
def set_to_rest(y, level):
    """Set to zero the numbers of a state (row, column) that are smaller than `level`."""
    for row in range(y.shape[0]):
        for j in range(y.shape[1]):
            y[row, j] = zero_below(level, y[row, j])


@inlined_by_llvm
def square_modulus(y, re, j):
    """Return the square modulus of the component whose real parts are the row `re` of a state.

    Parts below TINY count as zero, which no tolerance sees: their squares would be subnormal.
    """
    real, imaginary = zero_below(TINY, y[re, j]), zero_below(TINY, y[re + 1, j])
    return real * real + imaginary * imaginary
