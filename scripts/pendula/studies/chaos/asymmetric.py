"""An arithmetic in which even data do not stay even, and how large the odd part of a solution is.

The library sums neighbours so that evenness survives rounding. Here they are summed from right to
left, as one writes it first, so that each step leaves an odd error of the order of rounding.
"""

from math import sqrt

from pendula.compiled import kernel
from pendula.models.amplitudes import traced
from pendula.models.chain import at_every_site, close
from pendula.models.generated import load_rule
from pendula.symbols import Value, abs2, conj


def asymmetric_i_dt(p, a: Value, b: Value) -> list[Value]:
    """Return i dA_n/dtau and i dB_n/dtau of (4), its neighbours summed from right to left."""
    return [
        p.epsilon * ((u.right - 2.0 * u) + u.left)
        + (p.omega * u + p.gamma * (conj(v) - conj(u)) + 0.5 * abs2(u) * u)
        for u, v in ((a, b), (b, a))
    ]


write_asymmetric = at_every_site(load_rule(traced(asymmetric_i_dt).rates, "y"))


@kernel
def asymmetric_rates(chain, y, dy):
    """Write the right-hand side of (4) at `y` into `dy`, in an arithmetic that is not even."""
    close(chain, y)
    write_asymmetric(chain, (y,), dy)


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
