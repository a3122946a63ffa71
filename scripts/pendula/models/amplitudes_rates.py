"""The right-hand side of the equations on a whole chain, and the parts that solvers split it into.

Sites go four at a time, as `fours`, where there are enough of them: written out, since compilers
leave up to fifteen sites of a row to be done one by one, half of a chain of the paper.
"""

from math import cos, sin

from pendula.compiled import kernel, merged
from pendula.simd import LANES, vec4_views

from .amplitudes import close, modulus2, site_rates


def everywhere(at):
    """Return what does `at(chain, states, re, j, dy)` on all sites of each component."""

    @merged
    def walk(chain, states, dy, width):
        last = dy.shape[1] - 1 - width  # where the last block starts: it overlaps the one before
        for re in range(0, dy.shape[0], 2):
            for j in range(1, dy.shape[1] - 1, width):
                at(chain, states, re, min(j, last), dy)

    @merged
    def write(chain, states, dy):
        """`states` is a tuple of states like `dy`; those of `at` are seen as it is, or as fours."""
        if dy.shape[1] - 2 < 2 * LANES:
            walk(chain, states, dy, 1)
        else:
            walk(chain, vec4_views(states), vec4_views((dy,))[0], LANES)

    return write


@merged
def rates_at(chain, states, re, j, dy):
    y = states[0]
    site_rates(chain, y, re, j, modulus2(y, re, j), dy)


@merged
def linear_at(chain, states, re, j, dy):
    site_rates(chain, states[0], re, j, 0.0, dy)


@merged
def midpoint_at(chain, states, re, j, dy):
    old, new, middle = states
    density = 0.5 * (modulus2(old, re, j) + modulus2(new, re, j))
    site_rates(chain, middle, re, j, density, dy)


write_rates, write_linear = everywhere(rates_at), everywhere(linear_at)
write_midpoint = everywhere(midpoint_at)


@kernel
def rates(chain, y, dy):
    """Write the right-hand side of equations (4) at `y` into `dy` (same shape)."""
    close(chain, y)
    write_rates(chain, (y,), dy)


@kernel
def linear_rates(chain, y, dy):
    """Write the linear terms of the right-hand side at `y` into `dy`."""
    close(chain, y)
    write_linear(chain, (y,), dy)


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
    write_midpoint(chain, (old, new, middle), dy)


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
