"""The chain that all models share: a state and its sites, what the ends see, and the walk over it.

State. A real array `y[row, 1 + site]` with two rows for each of the two components (A and B, or x
and y), or the rows of the first alone where the two are the same. The sites are -M..M, or 0..M
where the data are even in n. The first and the last column are ghosts, which hold what the ends of
the chain see beyond themselves, so that no formula needs to know where it is.

Bits. Both symmetries are invariants of the equations, and the kernels keep them to the last bit:
neighbours are summed as (right + left) - 2 centre, which rounds alike under reflection, and both
components go through the same operations in the same order. Half of an even chain and one component
of a chain whose components are the same therefore have the bits of the whole.

A `chain` is what a model takes for its parameters, with the kinds of its two ends, `left` and
`right`.
"""

from collections.abc import Callable

from latticode.equations.ends import ANTIPERIODIC, FREE, MIRROR, PERIODIC
from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.kernels.simd import LANES, vector_views


@kernel
def close(chain, y) -> None:
    """Fill the ghost columns of `y` with what the ends of the chain see.

    A site next to a free end sees its own value, so that its bond vanishes. A mirror stands at
    site 0 of an even chain, whose left neighbour has the value of the right one.
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
def seen_at(chain, site, sites) -> int:
    """Return the site, counted from 0, whose value stands at `site`; -1 where one at rest does."""
    if 0 <= site < sites:
        return site
    end = chain.left if site < 0 else chain.right
    if end == FREE:
        return -1 - site if site < 0 else 2 * sites - 1 - site
    if end in (PERIODIC, ANTIPERIODIC):
        return site + sites if site < 0 else site - sites
    return -site if end == MIRROR else -1


@kernel
def sign_at(chain, site, sites) -> float:
    """Return the factor of the value that stands at `site`, counted from 0."""
    outside = site < 0 or site >= sites
    return -1.0 if outside and chain.left == ANTIPERIODIC else 1.0


@kernel
def widen(chain, y, wide) -> None:
    """Write the rows of `y` into `wide`, which has more ghost columns, and fill these."""
    sites = y.shape[1] - 2
    reach = (wide.shape[1] - sites) // 2
    for row in range(y.shape[0]):
        for j in range(wide.shape[1]):
            site = seen_at(chain, j - reach, sites)
            sign = sign_at(chain, j - reach, sites)
            wide[row, j] = sign * y[row, 1 + site] if site >= 0 else 0.0


@kernel
def unfold(chain, y, wide) -> None:
    """Write the rows of `y`, which may be half of an even chain, into `wide`.

    This has all sites of the chain and as many more at each end, which are filled.
    """
    sites, middle = y.shape[1] - 2, wide.shape[1] // 2
    for row in range(y.shape[0]):
        for j in range(wide.shape[1]):
            place = abs(j - middle) if chain.left == MIRROR else j - middle + sites // 2
            site, sign = seen_at(chain, place, sites), sign_at(chain, place, sites)
            wide[row, j] = sign * y[row, 1 + site] if site >= 0 else 0.0


@inlined_by_llvm
def sum_from_middle(terms) -> float:
    """Return the sum of a row (column,) of the whole chain, from its middle outwards.

    The sites n and -n come together, so that even data and their reflection have the same bits.
    """
    middle = terms.size // 2
    total = terms[middle]
    for n in range(1, middle):
        total += terms[middle + n] + terms[middle - n]
    return total


@inlined_by_llvm
def modulus2(y, re, j) -> float:
    """Return |A_n|^2 (or |B_n|^2) at column `j`; `re` is the row of the real parts."""
    return y[re, j] * y[re, j] + y[re + 1, j] * y[re + 1, j]


@kernel
def can_be_tiled(chain) -> bool:
    """Return whether tiles of the chain may take a step one by one: the two ends of a ring meet."""
    return chain.left != PERIODIC and chain.left != ANTIPERIODIC


def at_every_site(rule, rows=2) -> Callable:
    """Return the function that applies `rule(chain, states, re, j, dy)` to all sites.

    It goes through both components, or takes so many `rows` at once, a vector of sites at a time
    where a row is as long as that. The last block of a row then overlaps the one before and writes
    the same bits again, which costs less than a remainder that goes site by site.
    """

    @inlined_by_llvm
    def walk(chain, states, dy, width):
        last = dy.shape[1] - 1 - width  # the column at which the last block starts
        for re in range(0, dy.shape[0], rows):
            for j in range(1, dy.shape[1] - 1, width):
                rule(chain, states, re, min(j, last), dy)

    @inlined_by_llvm
    def write(chain, states, dy):
        """`states` is a tuple of states of the shape of `dy`, whose ghosts are filled."""
        if dy.shape[1] - 2 < LANES:
            walk(chain, states, dy, 1)
        else:
            walk(chain, vector_views(states), vector_views((dy,))[0], LANES)

    return write
