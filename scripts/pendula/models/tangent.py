"""The variational equations of (4): how tangent vectors of a solution move along with it.

A tangent vector is a small perturbation (a, b) of a state (A, B), to first order. A bundle is an
array of states stacked by rows, four rows each: first a solution, then its tangent vectors, all
with the ghost columns and the ends of one chain.
"""

from pendula.compiled import inlined_by_llvm, kernel

from .amplitudes import modulus2, rates, site_rates
from .chain import at_every_site, close

ROWS = 4
"""Rows of one state: Re A, Im A, Re B, Im B."""


@inlined_by_llvm
def tangent_rates_at_site(chain, states, re, j, dw):
    y, w, im = states[0], states[1], re + 1
    site_rates(chain, w, re, j, modulus2(y, re, j), dw)
    half_change = y[re, j] * w[re, j] + y[im, j] * w[im, j]  # Re(conj(A) a), half that of |A|^2
    dw[re, j] = dw[re, j] + half_change * y[im, j]
    dw[im, j] = dw[im, j] - half_change * y[re, j]


write_tangent_rates = at_every_site(tangent_rates_at_site)


@kernel
def tangent_rates(chain, y, w, dw):
    """Write the rate of the tangent vector `w` of the state `y` into `dw` (all of one shape).

    The derivative of |A|^2 A / 2 along a is |A|^2 a / 2, the cubic term of (4) at a given |A|^2,
    plus Re(conj(A) a) A, half of the change of |A|^2 times A. The ghosts of `y` must be filled.
    """
    close(chain, w)
    write_tangent_rates(chain, (y, w), dw)


@kernel
def bundle_rates(chain, bundle, slopes):
    """Write the rates of a solution and of its tangent vectors into `slopes`, shaped alike."""
    y = bundle[:ROWS]
    rates(chain, y, slopes[:ROWS])
    for first in range(ROWS, bundle.shape[0], ROWS):
        tangent_rates(chain, y, bundle[first : first + ROWS], slopes[first : first + ROWS])
