"""The conserved energy (8), with the bonds that belong to each kind of end."""

import numpy as np

from pendula.compiled import kernel

from .amplitudes import MIRROR, PERIODIC, close, modulus2


@kernel
def fill_sites(chain, y, out):
    """Write into out[j] the terms of (8) that live on the site in column j."""
    for j in range(1, y.shape[1] - 1):
        density = modulus2(y, 0, j)
        out[j] = density * (0.25 * density + chain.omega)
    if y.shape[0] == 4:
        for j in range(1, y.shape[1] - 1):
            density = modulus2(y, 2, j)
            real, imaginary = y[0, j] - y[2, j], y[1, j] - y[3, j]
            drive = chain.gamma * (real * real - imaginary * imaginary)
            out[j] += density * (0.25 * density + chain.omega) - drive


@kernel
def fill_bonds(y, out):
    """Write |A_i - A_j|^2 + |B_i - B_j|^2 of columns j and j + 1, ghosts included, into out[j]."""
    for row in range(y.shape[0]):
        for j in range(y.shape[1] - 1):
            difference = y[row, j + 1] - y[row, j]
            square = difference * difference
            out[j] = square if row == 0 else out[j] + square


@kernel
def energy_in(chain, y, scratch):
    """Return H of equation (8) for the whole chain, of which `y` may be a half or one component.

    Beyond a Dirichlet end hangs a site at rest: its bond is |A_M|^2 (and |A_{-M}|^2 on the other
    side). A free end has no bond, a ring has one bond that joins its ends. The sums run from the
    centre outwards in pairs of sites, so that half a chain gives the same bits as the whole.
    `scratch` holds two rows of as many columns as `y`.
    """
    close(chain, y)
    sites, bonds = scratch[0], scratch[1]
    fill_sites(chain, y, sites)
    fill_bonds(y, bonds)
    mirrored = chain.left == MIRROR
    reach = y.shape[1] - 3 if mirrored else (y.shape[1] - 3) // 2
    centre = 1 if mirrored else 1 + reach
    on_sites, on_bonds = sites[centre], 0.0
    for n in range(reach + 1):
        right, left = centre + n, centre + n if mirrored else centre - n
        if n > 0:
            on_sites += sites[right] + sites[left]
        on_bonds += bonds[right]
        if n < reach or chain.left != PERIODIC:
            on_bonds += bonds[left] if mirrored else bonds[left - 1]
    copies = 4 // y.shape[0]  # A = B: the one component that is stored counts twice
    return copies * (on_sites - chain.epsilon * on_bonds)


@kernel
def energy(chain, y):
    """Return H of equation (8) for the state `y`; see `energy_in`."""
    return energy_in(chain, y, np.empty((2, y.shape[1])))
