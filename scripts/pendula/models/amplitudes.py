"""Kernels of the coupled dNLS equations (4) of the paper on a finite chain, and their energy (8).

Right-hand sides, power series, and the mean over a step for `delfour_fortin_payre` are generated
from the traced model (`equations`). A state has the rows Re A, Im A, Re B, Im B, or only the first
two if A = B (see `latticode.generation.chain`).
"""

from typing import NamedTuple

import numpy as np
from latticode.equations.ends import DIRICHLET, PERIODIC
from latticode.equations.graph import neg
from latticode.generation.chain import MIRROR, at_every_site, close, modulus2
from latticode.generation.chain import can_be_tiled as can_be_tiled
from latticode.generation.modules import load_function, load_rule, load_series
from latticode.integrators.taylor import PowerSeries
from latticode.kernels.compiled import kernel
from latticode.simulation.observables import ObservableRecord, observe_moduli

from .equations import AMPLITUDE_MODEL, CONSERVING_MODEL


class AmplitudeChain(NamedTuple):
    """Parameters of the equations (coupling, drive, detuning) and the kinds of the two ends."""

    epsilon: float
    gamma: float
    omega: float
    left: int
    right: int


@kernel
def system_of_tile(chain: AmplitudeChain, at_left_end: bool, at_right_end: bool) -> AmplitudeChain:
    """Return the chain of a tile: the ends of the full chain where the tile reaches them.

    Elsewhere the kind of an end does not matter: its error stays in the margin of the tile.
    """
    left = chain.left if at_left_end else DIRICHLET
    right = chain.right if at_right_end else DIRICHLET
    return AmplitudeChain(chain.epsilon, chain.gamma, chain.omega, left, right)


# --- Functions generated from the traced model ---------------------------------------------------

_re_rate, _im_rate = AMPLITUDE_MODEL.rates[:2]
field = load_function((neg(_im_rate), _re_rate))
"""The function (constants, seen) -> (Re F, Im F) for A, where i A' = F; for B, exchange A and B.

See `generation.modules.load_function`; in `seen`, A is field 0 and B is field 1."""
continue_in_waves = load_series(AMPLITUDE_MODEL).continue_in_waves
write_rates = at_every_site(load_rule(AMPLITUDE_MODEL.rates, "y"))


@kernel
def continue_series(chain: AmplitudeChain, series: PowerSeries) -> None:
    """Write the coefficients of all orders from those of order 0."""
    continue_in_waves(chain, series)


@kernel
def rates(chain: AmplitudeChain, y: np.ndarray, dy: np.ndarray) -> None:
    """Write the right-hand side of equations (4) at `y` into `dy` (same shape)."""
    close(chain, y)
    write_rates(chain, (y,), dy)


write_tangent_rates = at_every_site(load_rule(AMPLITUDE_MODEL.tangent().rates[4:], "y", "w"))


@kernel
def tangent_rates(chain: AmplitudeChain, y: np.ndarray, w: np.ndarray, dw: np.ndarray) -> None:
    """Write the rate of `w`, a small perturbation of the state `y`, into `dw` (all of one shape).

    The ghost columns of `y` must be filled.
    """
    close(chain, w)
    write_tangent_rates(chain, (y, w), dw)


write_mean_rates = at_every_site(load_rule(CONSERVING_MODEL.rates[8:], "old", "new", "mean"))


@kernel
def mean_rates(
    chain: AmplitudeChain, old: np.ndarray, new: np.ndarray, middle: np.ndarray, dy: np.ndarray
) -> None:
    """Write the energy-conserving mean of the right-hand side between `old` and `new` into `dy`.

    See `mean_i_dt`; the mean state is written into `middle`. A step with these rates has
    H(new) = H(old) exactly (Delfour, Fortin and Payre, J. Comput. Phys. 44 (1981) 277).
    """
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            middle[row, j] = 0.5 * (old[row, j] + new[row, j])
    close(chain, middle)
    write_mean_rates(chain, (old, new, middle), dy)


# --- The conserved energy -----------------------------------------------------------------------


@kernel
def fill_site_terms(chain: AmplitudeChain, y: np.ndarray, out: np.ndarray) -> None:
    """Write into out[j] the terms of (8) on the site in column j.

    They are |A|^4 / 4 + Omega |A|^2, the same terms of B, and the drive -gamma Re (A - B)^2.
    """
    for j in range(1, y.shape[1] - 1):
        square = modulus2(y, 0, j)
        out[j] = square * (0.25 * square + chain.omega)
    if y.shape[0] == 4:
        for j in range(1, y.shape[1] - 1):
            square = modulus2(y, 2, j)
            real, imaginary = y[0, j] - y[2, j], y[1, j] - y[3, j]
            drive = chain.gamma * (real * real - imaginary * imaginary)
            out[j] += square * (0.25 * square + chain.omega) - drive


@kernel
def fill_bond_terms(y: np.ndarray, out: np.ndarray) -> None:
    """Write |A_i - A_j|^2 + |B_i - B_j|^2 of columns j and j + 1, ghosts included, into out[j]."""
    for row in range(y.shape[0]):
        for j in range(y.shape[1] - 1):
            difference = y[row, j + 1] - y[row, j]
            square = difference * difference
            out[j] = square if row == 0 else out[j] + square


@kernel
def energy_with_scratch(chain: AmplitudeChain, y: np.ndarray, scratch: np.ndarray) -> float:
    """Return H of equation (8) for the full chain; `y` may hold half of it, or one component.

    A Dirichlet end has a bond with a site at rest, |A_M|^2 (|A_{-M}|^2 on the other side). A free
    end has no bond. A ring has one bond that joins its ends. The sums run from the centre outwards
    in pairs of sites, because half a chain then gives the same bits as the full one.
    `scratch` has two rows of as many columns as `y`.
    """
    close(chain, y)
    sites, bonds = scratch[0], scratch[1]
    fill_site_terms(chain, y, sites)
    fill_bond_terms(y, bonds)
    mirrored = chain.left == MIRROR
    reach = y.shape[1] - 3 if mirrored else (y.shape[1] - 3) // 2  # sites on one side of the centre
    centre = 1 if mirrored else 1 + reach
    on_sites, on_bonds = sites[centre], 0.0
    for n in range(reach + 1):
        right, left = centre + n, centre + n if mirrored else centre - n
        if n > 0:
            on_sites += sites[right] + sites[left]
        # bonds[j] joins columns j and j + 1. To the left of a column is bonds[j - 1]; in a mirrored
        # chain it is the reflection of the bond to the right.
        on_bonds += bonds[right]
        if n < reach or chain.left != PERIODIC:
            on_bonds += bonds[left] if mirrored else bonds[left - 1]
    copies = 4 // y.shape[0]  # A = B: one component is stored, and counts twice
    return copies * (on_sites - chain.epsilon * on_bonds)


def energy(chain: AmplitudeChain, y: np.ndarray) -> float:
    """Return H of equation (8) for the state `y`; see `energy_with_scratch`."""
    return energy_with_scratch(chain, y, np.empty((2, y.shape[1])))


@kernel
def energies(
    chain: AmplitudeChain, states: np.ndarray, scratch: np.ndarray, out: np.ndarray
) -> None:
    """Write H of each of `states` (count, row, column) to `out`; `scratch` is (2, column)."""
    for i in range(len(states)):
        out[i] = energy_with_scratch(chain, states[i], scratch)


@kernel
def observe(chain: AmplitudeChain, y: np.ndarray, i: int, record: ObservableRecord) -> None:
    """Write the observables of the state `y` of (4), with its energy, as output `i` of `record`."""
    observe_moduli(chain, y, i, record)
    if record.conserved.size > 0:
        record.conserved[0, i] = energy_with_scratch(chain, y, record.scratch)
