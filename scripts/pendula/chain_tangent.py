"""The variational equations of (4): how small changes of a state move along with it.

A bundle is an array of states stacked by rows, four rows each: first a solution, then as many
changes of it, all with the ghost columns and the ends of one chain.
"""

from .chain import close, modulus2, site_rates
from .chain_rates import count_blocks, few, rates, start_of_block
from .compiled import kernel, merged
from .fours import fours
from .vectors import LANES

ROWS = 4
"""Rows of one state: Re A, Im A, Re B, Im B."""


@merged
def write_tangent(chain, y, w, dw, width):
    for re in range(0, y.shape[0], 2):
        im = re + 1
        for block in range(count_blocks(y, width)):
            j = start_of_block(y, block, width)
            site_rates(chain, w, re, j, modulus2(y, re, j), dw)
            change = y[re, j] * w[re, j] + y[im, j] * w[im, j]
            dw[re, j] = dw[re, j] + change * y[im, j]
            dw[im, j] = dw[im, j] - change * y[re, j]


@kernel
def tangent_rates(chain, y, w, dw):
    """Write the rate of the change `w` of the state `y` into `dw` (all of one shape).

    The cubic term |A|^2 A / 2 changes by |A|^2 a / 2, as in (4) at a given density, and by
    Re(conj(A) a) A, half of the change of that density.
    """
    close(chain, w)
    if few(y):
        write_tangent(chain, y, w, dw, 1)
    else:
        write_tangent(chain, fours(y), fours(w), fours(dw), LANES)


@kernel
def bundle_rates(chain, bundle, slopes):
    """Write the rates of a solution and of its changes into `slopes`, of the bundle's shape."""
    y = bundle[:ROWS]
    rates(chain, y, slopes[:ROWS])
    for first in range(ROWS, bundle.shape[0], ROWS):
        tangent_rates(chain, y, bundle[first : first + ROWS], slopes[first : first + ROWS])
