"""For all models: the layout of a state, values beyond the chain's ends, the loop over sites.

State. A state is a real array `y[row, 1 + site]` with two rows for each component (A and B, or x
and y). If both components are equal, it contains only the first. Sites are -M..M, or 0..M if the
data are even in n. The first and last columns are ghosts: they contain the values beyond the ends,
so that one formula applies to all sites.

Bits. The equations preserve two symmetries, reflected sites and exchanged components. The kernels
preserve both to the last bit. Neighbours are summed as (right + left) - 2 centre, which has the
same rounding after a reflection. Both components undergo the same operations in the same order.
Half of an even chain thus gives the bits of the whole chain, and one of two equal components gives
the bits of both.

A `chain` is a named tuple with the model's parameters and the kinds of its ends, `left`, `right`.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from latticode.equations.ends import ANTIPERIODIC, FREE, MIRROR, PERIODIC
from latticode.kernels.compiled import in_one_pass, inlined_by_llvm, kernel
from latticode.kernels.simd import LANES, vector_views

Array = np.ndarray


@kernel
def close(chain: Any, y: Array) -> None:
    """Fill the ghost columns of `y` with the values beyond the ends of the chain.

    The ghost beyond a free end has the value of the last site, so the bond between them vanishes.
    The mirror of an even chain is at site 0: both neighbours of this site have the same value.
    """
    n = y.shape[1] - 2
    for row in range(y.shape[0]):
        y[row, 0] = 0.0
        if chain.left == FREE:
            y[row, 0] = y[row, 1]
        elif chain.left == PERIODIC:
            y[row, 0] = y[row, n]
        elif chain.left == MIRROR:
            y[row, 0] = y[row, 2]
        elif chain.left == ANTIPERIODIC:
            y[row, 0] = -y[row, n]
        y[row, n + 1] = 0.0
        if chain.right == FREE:
            y[row, n + 1] = y[row, n]
        elif chain.right == PERIODIC:
            y[row, n + 1] = y[row, 1]
        elif chain.right == ANTIPERIODIC:
            y[row, n + 1] = -y[row, 1]


@kernel
def seen_at(chain: Any, site: int, sites: int) -> int:
    """Return the site from which `site` gets its value; -1 if `site` is at rest.

    Sites are counted from 0. `site` may lie beyond an end of the chain.
    """
    if 0 <= site < sites:
        return site
    end = chain.left if site < 0 else chain.right
    if end == FREE:
        return -1 - site if site < 0 else 2 * sites - 1 - site
    if end in (PERIODIC, ANTIPERIODIC):
        return site + sites if site < 0 else site - sites
    return -site if end == MIRROR else -1


@kernel
def sign_at(chain: Any, site: int, sites: int) -> float:
    """Return 1 or -1: the value at `site` is this factor times the value at the site `seen_at`."""
    outside = site < 0 or site >= sites
    return -1.0 if outside and chain.left == ANTIPERIODIC else 1.0


@kernel
def widen(chain: Any, y: Array, wide: Array) -> None:
    """Copy the rows of `y` to `wide`, which has more ghost columns, and fill all of its ghosts."""
    sites = y.shape[1] - 2
    reach = (wide.shape[1] - sites) // 2
    for row in range(y.shape[0]):
        for j in range(wide.shape[1]):
            site = seen_at(chain, j - reach, sites)
            sign = sign_at(chain, j - reach, sites)
            wide[row, j] = sign * y[row, 1 + site] if site >= 0 else 0.0


@kernel
def unfold(chain: Any, y: Array, wide: Array) -> None:
    """Write the rows of `y`, which may be half of an even chain, into `wide`.

    `wide` has all sites of the chain. Its ghost columns at both ends are filled too.
    """
    sites, middle = y.shape[1] - 2, wide.shape[1] // 2
    for row in range(y.shape[0]):
        for j in range(wide.shape[1]):
            place = abs(j - middle) if chain.left == MIRROR else j - middle + sites // 2
            site, sign = seen_at(chain, place, sites), sign_at(chain, place, sites)
            wide[row, j] = sign * y[row, 1 + site] if site >= 0 else 0.0


@inlined_by_llvm
def sum_from_middle(terms: Array) -> float:
    """Return the sum of a row (column,) of the whole chain, added from the middle outwards.

    First the terms of n and -n are added, so that data and their reflection have the same sum.
    """
    middle = terms.size // 2
    total = terms[middle]
    for n in range(1, middle):
        total += terms[middle + n] + terms[middle - n]
    return total


@inlined_by_llvm
def modulus2(y: Array, re: int, j: int) -> float:
    """Return |A_n|^2 (or |B_n|^2) at column `j`; `re` is the row of the real parts."""
    return y[re, j] * y[re, j] + y[re + 1, j] * y[re + 1, j]


@kernel
def can_be_tiled(chain: Any) -> bool:
    """Return whether a step may be computed tile by tile, which is impossible on a ring."""
    return chain.left != PERIODIC and chain.left != ANTIPERIODIC


def at_every_site(rule: Callable, rows: int = 2) -> Callable:
    """Return write(chain, states, dy), which applies `rule(chain, states, re, j, dy)` to all sites.

    The rule writes `rows` rows from row `re` on, by default the two rows of a component. If a row
    has at least LANES sites, it is processed in vectors. The last vector may overlap the previous
    vector and write the same bits again, which is faster than single sites.
    """

    @in_one_pass
    def walk(chain: Any, states: tuple, dy: Any, width: int) -> None:
        last = dy.shape[1] - 1 - width  # the column at which the last block starts
        for re in range(0, dy.shape[0], rows):
            for j in range(1, dy.shape[1] - 1, width):
                rule(chain, states, re, min(j, last), dy)

    @in_one_pass
    def write(chain: Any, states: tuple, dy: Array) -> None:
        """Write `dy` from a tuple of states with filled ghosts."""
        if dy.shape[1] - 2 < LANES:
            walk(chain, states, dy, 1)
        else:
            walk(chain, vector_views(states), vector_views((dy,))[0], LANES)

    return write
