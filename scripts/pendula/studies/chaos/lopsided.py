"""An arithmetic in which even data do not stay even, and how large the odd part of a solution is.

The library sums neighbours so that evenness survives rounding. Here they are summed from right to
left, as one writes it first, so that each step leaves an odd error of the order of rounding.
"""

from math import sqrt

from pendula.compiled import inlined_by_llvm, kernel
from pendula.models.amplitudes import field, modulus2
from pendula.models.chain import at_every_site, close


@inlined_by_llvm
def lopsided_field(chain, drive, left, u, right, partner, squared_modulus):
    """Return one part of the right-hand side of (4), its neighbours summed from right to left."""
    coupling = chain.epsilon * ((right - 2.0 * u) + left)
    # where a site and its neighbours are alike, the field has no coupling of its own
    return coupling + field(chain, drive, u, u, u, partner, squared_modulus)


@inlined_by_llvm
def lopsided_part(chain, drive, y, row, other, j, squared_modulus):
    """Return the right-hand side from one row at column `j`; `other` is that of the partner."""
    before, here, after = y[row, j - 1], y[row, j], y[row, j + 1]
    return lopsided_field(chain, drive, before, here, after, y[other, j], squared_modulus)


@inlined_by_llvm
def lopsided_at(chain, states, re, j, dy):
    y, im, other = states[0], re + 1, dy.shape[0] - 2 - re
    squared_modulus = modulus2(y, re, j)
    dy[re, j] = lopsided_part(chain, -chain.gamma, y, im, other + 1, j, squared_modulus)
    dy[im, j] = -lopsided_part(chain, chain.gamma, y, re, other, j, squared_modulus)


write_lopsided = at_every_site(lopsided_at)


@kernel
def lopsided_rates(chain, y, dy):
    """Write the right-hand side of (4) at `y` into `dy`, in an arithmetic that is not even."""
    close(chain, y)
    write_lopsided(chain, (y,), dy)


@kernel
def odd_part(y):
    """Return the l2 norm of the part of a state that is odd in n, relative to the whole."""
    last = y.shape[1] - 1
    part = whole = 0.0
    for row in range(y.shape[0]):
        for j in range(1, last):
            half = 0.5 * (y[row, j] - y[row, last - j])
            part += half * half
            whole += y[row, j] * y[row, j]
    return sqrt(part / whole)
