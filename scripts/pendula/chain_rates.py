"""The right-hand side of the equations on a whole chain, and the parts that solvers split it into.

Sites go four at a time, as `fours`, where there are enough of them: written out, since compilers
leave up to fifteen sites of a row to be done one by one, half of a chain of the paper.
"""

from math import cos, sin

from .chain import close, modulus2, site_rates
from .compiled import kernel, merged
from .fours import fours
from .vectors import LANES


@merged
def few(y):
    """Return whether there are too few sites for blocks of four."""
    return y.shape[1] - 2 < 2 * LANES


@merged
def count_blocks(y, width):
    """Return how many blocks of sites there are."""
    return (y.shape[1] - 2 + width - 1) // width


@merged
def start_of_block(y, block, width):
    """Return the first column of a block; the last overlaps the one before it."""
    return min(1 + block * width, y.shape[1] - 1 - width)


@merged
def write_rates(chain, y, dy, width):
    for re in range(0, y.shape[0], 2):
        for block in range(count_blocks(y, width)):
            j = start_of_block(y, block, width)
            site_rates(chain, y, re, j, modulus2(y, re, j), dy)


@kernel
def rates(chain, y, dy):
    """Write the right-hand side of equations (4) at `y` into `dy` (same shape)."""
    close(chain, y)
    if few(y):
        write_rates(chain, y, dy, 1)
    else:
        write_rates(chain, fours(y), fours(dy), LANES)


@merged
def write_linear(chain, y, dy, width):
    for re in range(0, y.shape[0], 2):
        for block in range(count_blocks(y, width)):
            site_rates(chain, y, re, start_of_block(y, block, width), 0.0, dy)


@kernel
def linear_rates(chain, y, dy):
    """Write the linear terms of the right-hand side at `y` into `dy`."""
    close(chain, y)
    if few(y):
        write_linear(chain, y, dy, 1)
    else:
        write_linear(chain, fours(y), fours(dy), LANES)


@kernel
def linear_radius(chain):
    """Return a bound of the linear terms at a state whose largest modulus is one."""
    return 4.0 * abs(chain.epsilon) + abs(chain.omega) + 2.0 * abs(chain.gamma)


@kernel
def turn(y, h):
    """Carry `y` along the cubic terms alone, which turn each amplitude at a rate of its own.

    Sine and cosine are the C library's: their last bits may differ from machine to machine.

    Return whether none turned by a radian or more: no splitting could follow that.
    """
    resolved = True
    for re in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            angle = 0.5 * h * modulus2(y, re, j)
            resolved &= abs(angle) < 1.0
            c, s = cos(angle), sin(angle)
            u, v = y[re, j], y[re + 1, j]
            y[re, j] = c * u + s * v
            y[re + 1, j] = c * v - s * u
    return resolved


@merged
def write_midpoint(chain, old, new, middle, dy, width):
    for re in range(0, old.shape[0], 2):
        for block in range(count_blocks(old, width)):
            j = start_of_block(old, block, width)
            density = 0.5 * (modulus2(old, re, j) + modulus2(new, re, j))
            site_rates(chain, middle, re, j, density, dy)


@kernel
def midpoint_rates(chain, old, new, middle, dy):
    """Write the energy-conserving mean of the right-hand side between `old` and `new` into `dy`.

    The linear terms act on the mean state (left in `middle`), the cubic one is the mean of |A|^2
    times the mean of A: then H(new) = H(old) exactly (Delfour, Fortin and Payre 1981).
    """
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            middle[row, j] = 0.5 * (old[row, j] + new[row, j])
    close(chain, middle)
    if few(old):
        write_midpoint(chain, old, new, middle, dy, 1)
    else:
        write_midpoint(chain, fours(old), fours(new), fours(middle), fours(dy), LANES)
