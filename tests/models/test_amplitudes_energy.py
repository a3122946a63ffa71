"""The energy against equation (8), and as the Hamiltonian of equation (4)."""

import itertools

import numpy as np
import pytest
from oracle import BOUNDARIES, hamiltonian, random_chain
from pendula.models.amplitudes import Chain, energy, rates
from pendula.simulation.lattice import Reduction, choose_ends, pack

CONSTANTS = (0.7, 1.3, -2.1)
WHOLE = Reduction(even=False, synchronised=False)
REDUCTIONS = [Reduction(even, same) for even in (False, True) for same in (False, True)]


def library_energy(z, numbers, boundary, reduction=WHOLE):
    """Return H as the library computes it from what `reduction` leaves of the chain."""
    return energy(Chain(*numbers, *choose_ends(boundary, reduction)), pack(z, reduction))


def derivative(chain, y, direction):
    """Return dH/ds of H(y + s direction) at 0: five points are exact for degree 4."""
    weights = {-2: 1 / 12, -1: -8 / 12, 1: 8 / 12, 2: -1 / 12}
    return sum(weight * energy(chain, y + s * direction) for s, weight in weights.items())


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_energy_is_equation_8(boundary):
    for half_width, reduction in [(0, WHOLE), *itertools.product([1, 2, 7], REDUCTIONS)]:
        z = random_chain(half_width, **reduction._asdict())
        expected = pytest.approx(hamiltonian(z, CONSTANTS, boundary), rel=1e-13)
        found = library_energy(z, CONSTANTS, boundary, reduction)
        assert found == expected, (half_width, reduction)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("half_width", [0, 1, 3])
def test_energy_generates_the_equations(half_width, boundary):
    """Hamilton's equations i A' = dH/d(conj A): Re A' = H_Im / 2 and Im A' = -H_Re / 2."""
    chain = Chain(*CONSTANTS, *choose_ends(boundary, WHOLE))
    y = pack(random_chain(half_width), WHOLE)
    dy = np.zeros_like(y)
    rates(chain, y, dy)
    gradient = np.zeros_like(y)
    for row, j in np.ndindex(4, y.shape[1] - 2):
        direction = np.zeros_like(y)
        direction[row, j + 1] = 1.0
        gradient[row, j + 1] = derivative(chain, y, direction)
    expected = np.stack([gradient[1], -gradient[0], gradient[3], -gradient[2]]) / 2
    np.testing.assert_allclose(dy[:, 1:-1], expected[:, 1:-1], rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("bonds", BOUNDARIES)
def test_only_the_bonds_of_the_boundary_are_conserved(bonds, boundary):
    chain = Chain(*CONSTANTS, *choose_ends(boundary, WHOLE))
    y = pack(random_chain(3), WHOLE)
    dy = np.zeros_like(y)
    rates(chain, y, dy)
    change = derivative(Chain(*CONSTANTS, *choose_ends(bonds, WHOLE)), y, dy)
    assert (abs(change) < 1e-10) == (bonds == boundary)
