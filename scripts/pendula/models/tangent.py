"""The variational equations of (4): how tangent vectors of a solution move along with it.

A tangent vector is a small perturbation (a, b) of a state (A, B), to first order. A bundle is an
array of states stacked by rows, four rows each: first a solution, then its tangent vectors, all
with the ghost columns and the ends of one chain.
"""

from latticode.generation.chain import at_every_site, close
from latticode.generation.modules import load_rule
from latticode.kernels.compiled import kernel

from .amplitudes import EQUATIONS, rates

ROWS = 4
"""Rows of one state: Re A, Im A, Re B, Im B."""
write_tangent_rates = at_every_site(load_rule(EQUATIONS.tangent().rates[ROWS:], "y", "w"))


@kernel
def tangent_rates(chain, y, w, dw):
    """Write the rate of the tangent vector `w` of the state `y` into `dw` (all of one shape).

    The ghosts of `y` must be filled.
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
