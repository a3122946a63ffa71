"""The conserved energy (8), with the bonds that belong to each kind of end."""

from .chain import MIRROR, PERIODIC, close, modulus2
from .compiled import kernel


@kernel
def site_energy(chain, y, j):
    """Return the terms of (8) that live on one site."""
    total = 0.0
    for re in range(0, y.shape[0], 2):
        density = modulus2(y, re, j)
        total += density * (0.25 * density + chain.omega)
    if y.shape[0] == 4:
        difference_re = y[0, j] - y[2, j]
        difference_im = y[1, j] - y[3, j]
        total -= chain.gamma * (difference_re * difference_re - difference_im * difference_im)
    return total


@kernel
def bond(y, i, j):
    """Return |A_i - A_j|^2 + |B_i - B_j|^2 for two columns, ghosts included."""
    total = 0.0
    for row in range(y.shape[0]):
        difference = y[row, i] - y[row, j]
        total += difference * difference
    return total


@kernel
def energy(chain, y):
    """Return H of equation (8) for the whole chain, of which `y` may be a half or one component.

    Beyond a Dirichlet end hangs a site at rest: its bond is |A_M|^2 (and |A_{-M}|^2 on the other
    side). A free end has no bond, a ring has one bond that joins its ends. The sums run from the
    centre outwards in pairs of sites, so that half a chain gives the same bits as the whole.
    """
    close(chain, y)
    mirrored = chain.left == MIRROR
    sites = y.shape[1] - 2
    reach = sites - 1 if mirrored else sites // 2
    centre = 1 if mirrored else 1 + reach
    side = 1 if mirrored else -1
    on_sites = site_energy(chain, y, centre)
    on_bonds = 0.0
    for n in range(reach + 1):
        right, left = centre + n, centre + side * n
        if n > 0:
            on_sites += site_energy(chain, y, right) + site_energy(chain, y, left)
        on_bonds += bond(y, right, right + 1)
        if n < reach or chain.left != PERIODIC:
            on_bonds += bond(y, left, left + side)
    copies = 4 // y.shape[0]  # A = B: the one component that is stored counts twice
    return copies * (on_sites - chain.epsilon * on_bonds)
