"""The variational equations of (4): how small changes of a state move along with it.

A bundle is an array of states stacked by rows, four rows each: first a solution, then as many
changes of it, all with the ghost columns and the ends of one chain.
"""

from pendula.compiled import kernel, merged

from .amplitudes import close, modulus2, site_rates
from .amplitudes_rates import everywhere, rates

ROWS = 4
"""Rows of one state: Re A, Im A, Re B, Im B."""


@merged
def tangent_at(chain, states, re, j, dw):
    y, w, im = states[0], states[1], re + 1
    site_rates(chain, w, re, j, modulus2(y, re, j), dw)
    change = y[re, j] * w[re, j] + y[im, j] * w[im, j]
    dw[re, j] = dw[re, j] + change * y[im, j]
    dw[im, j] = dw[im, j] - change * y[re, j]


write_tangent = everywhere(tangent_at)


@kernel
def tangent_rates(chain, y, w, dw):
    """Write the rate of the change `w` of the state `y` into `dw` (all of one shape).

    The cubic term |A|^2 A / 2 changes by |A|^2 a / 2, as in (4) at a given density, and by
    Re(conj(A) a) A, half of the change of that density.
    """
    close(chain, w)
    write_tangent(chain, (y, w), dw)


@kernel
def bundle_rates(chain, bundle, slopes):
    """Write the rates of a solution and of its changes into `slopes`, of the bundle's shape."""
    y = bundle[:ROWS]
    rates(chain, y, slopes[:ROWS])
    for first in range(ROWS, bundle.shape[0], ROWS):
        tangent_rates(chain, y, bundle[first : first + ROWS], slopes[first : first + ROWS])
