"""The coupled dNLS equations (4) of the paper on a finite chain, and their energy (8).

    i dA_n/dtau = epsilon (A_{n+1} - 2 A_n + A_{n-1}) + Omega A_n
                  + gamma (conj B_n - conj A_n) + |A_n|^2 A_n / 2,

and the same with A and B exchanged. What stands here: the equations as a traced model, from which
right-hand sides and power series follow, their mean over a step for `delfour_fortin_payre`, and the
energy. A state has the rows Re A, Im A, Re B, Im B, or the first two alone where A = B (see
`chain`). Whoever changes an order of operations here changes every result
(tests/test_same_bits.py).
"""

from typing import NamedTuple

import numpy as np
from latticode.equations.ends import DIRICHLET, PERIODIC
from latticode.equations.graph import neg
from latticode.equations.model import Model, Value, abs2, conj, lap
from latticode.generation.chain import MIRROR, at_every_site, close, modulus2
from latticode.generation.modules import load_function, load_rule, load_series
from latticode.kernels.compiled import kernel


class Chain(NamedTuple):
    """Parameters of the equations (coupling, drive, detuning) and the kinds of the two ends."""

    epsilon: float
    gamma: float
    omega: float
    left: int
    right: int


@kernel
def chain_of_tile(chain, at_left_end, at_right_end):
    """Return the chain of a tile, which ends as the whole chain does where it reaches an end.

    Elsewhere the kind of end does not matter: what is wrong there stays in the margin of the tile.
    """
    left = chain.left if at_left_end else DIRICHLET
    right = chain.right if at_right_end else DIRICHLET
    return Chain(chain.epsilon, chain.gamma, chain.omega, left, right)


# --- The equations as a traced model, and what is generated from it -----------------------------


def linear(p, u: Value, v: Value) -> Value:
    """Return the linear terms of i dA_n/dtau, where u is A and v is B, or the other way round."""
    return p.epsilon * lap(u) + p.omega * u + p.gamma * (conj(v) - conj(u))


def i_dt(p, a: Value, b: Value) -> list[Value]:
    """Return i dA_n/dtau and i dB_n/dtau."""
    return [linear(p, u, v) + 0.5 * abs2(u) * u for u, v in ((a, b), (b, a))]


def mean_i_dt(p, *fields: Value) -> list[Value]:
    """Return the mean over a step from one pair of fields to a second; the third is their mean.

    The linear terms act on the mean state, the cubic one is the mean of |A|^2 times the mean of A.
    """
    old, new, mean = fields[:2], fields[2:4], fields[4:]
    return [0.0] * 4 + [
        linear(p, u, v) + 0.5 * (0.5 * (abs2(first) + abs2(last))) * u
        for first, last, u, v in zip(old, new, mean, mean[::-1], strict=True)
    ]


PARAMETERS = dict.fromkeys(Chain._fields[:3], 1.0)
AMPLITUDES = Model(fields=("A", "B"), parameters=PARAMETERS, i_dt=i_dt, name="amplitudes")
"""(4) as problems have it; `integrations` says how it is integrated."""
MEANS = [f"{name}{i}" for i in range(3) for name in "AB"]
CONSERVING = Model(fields=MEANS, parameters=PARAMETERS, i_dt=mean_i_dt)
_re_rate, _im_rate = AMPLITUDES.rates[:2]
field = load_function((neg(_im_rate), _re_rate))
"""The function (constants, seen) -> (Re F, Im F) for A, where i A' = F; for B with both exchanged.

See `generated.load_function`; `seen` counts A as field 0 and B as field 1."""
continue_series = load_series(AMPLITUDES).continue_in_waves
"""Writes the coefficients of all orders from those of order 0, given a chain and a series."""
write_rates = at_every_site(load_rule(AMPLITUDES.rates, "y"))


@kernel
def rates(chain, y, dy):
    """Write the right-hand side of equations (4) at `y` into `dy` (same shape)."""
    close(chain, y)
    write_rates(chain, (y,), dy)


write_tangent_rates = at_every_site(load_rule(AMPLITUDES.tangent().rates[4:], "y", "w"))


@kernel
def tangent_rates(chain, y, w, dw):
    """Write the rate of `w`, a small perturbation of the state `y`, into `dw` (all of one shape).

    The ghosts of `y` must be filled.
    """
    close(chain, w)
    write_tangent_rates(chain, (y, w), dw)


write_midpoint_rates = at_every_site(load_rule(CONSERVING.rates[8:], "old", "new", "mean"))


@kernel
def midpoint_rates(chain, old, new, middle, dy):
    """Write the energy-conserving mean of the right-hand side between `old` and `new` into `dy`.

    See `mean_i_dt`; `middle` is left with the mean state. Then H(new) = H(old) exactly (Delfour,
    Fortin and Payre, J. Comput. Phys. 44 (1981) 277).
    """
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            middle[row, j] = 0.5 * (old[row, j] + new[row, j])
    close(chain, middle)
    write_midpoint_rates(chain, (old, new, middle), dy)


# --- The conserved energy -----------------------------------------------------------------------


@kernel
def fill_site_terms(chain, y, out):
    """Write into out[j] the terms of (8) that live on the site in column j.

    They are |A|^4 / 4 + Omega |A|^2, the same of B, and the drive -gamma Re (A - B)^2.
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
def fill_bond_terms(y, out):
    """Write |A_i - A_j|^2 + |B_i - B_j|^2 of columns j and j + 1, ghosts included, into out[j]."""
    for row in range(y.shape[0]):
        for j in range(y.shape[1] - 1):
            difference = y[row, j + 1] - y[row, j]
            square = difference * difference
            out[j] = square if row == 0 else out[j] + square


@kernel
def energy_with_scratch(chain, y, scratch):
    """Return H of equation (8) for the whole chain; `y` may hold half of it, or one component.

    Beyond a Dirichlet end hangs a site at rest: its bond is |A_M|^2 (and |A_{-M}|^2 on the other
    side). A free end has no bond, a ring has one bond that joins its ends. The sums run from the
    centre outwards in pairs of sites, so that half a chain gives the same bits as the whole.
    `scratch` holds two rows of as many columns as `y`.
    """
    close(chain, y)
    sites, bonds = scratch[0], scratch[1]
    fill_site_terms(chain, y, sites)
    fill_bond_terms(y, bonds)
    mirrored = chain.left == MIRROR
    reach = y.shape[1] - 3 if mirrored else (y.shape[1] - 3) // 2  # sites beside the centre
    centre = 1 if mirrored else 1 + reach
    on_sites, on_bonds = sites[centre], 0.0
    for n in range(reach + 1):
        right, left = centre + n, centre + n if mirrored else centre - n
        if n > 0:
            on_sites += sites[right] + sites[left]
        # bonds[j] joins columns j and j + 1; that to the left of a column is bonds[j - 1], and on
        # the other half of a mirrored chain it is the reflection of the bond to the right
        on_bonds += bonds[right]
        if n < reach or chain.left != PERIODIC:
            on_bonds += bonds[left] if mirrored else bonds[left - 1]
    copies = 4 // y.shape[0]  # A = B: the one component that is stored counts twice
    return copies * (on_sites - chain.epsilon * on_bonds)


def energy(chain, y):
    """Return H of equation (8) for the state `y`; see `energy_with_scratch`."""
    return energy_with_scratch(chain, y, np.empty((2, y.shape[1])))


@kernel
def energies(chain, states, scratch, out):
    """Write H of each of `states` (count, row, column) to `out`; `scratch` is (2, column)."""
    for i in range(len(states)):
        out[i] = energy_with_scratch(chain, states[i], scratch)
