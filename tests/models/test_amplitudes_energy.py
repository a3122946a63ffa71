"""The energy against equation (8), and as the Hamiltonian of equation (4)."""

import itertools

import pytest
from latticode.simulation.lattice import Reduction, choose_ends, pack
from oracle import BOUNDARIES, hamiltonian, random_chain
from pendula.models.amplitudes import Chain, energy

CONSTANTS = (0.7, 1.3, -2.1)
WHOLE = Reduction(even=False, synchronised=False)
REDUCTIONS = [Reduction(even, same) for even in (False, True) for same in (False, True)]


def library_energy(z, numbers, boundary, reduction=WHOLE):
    """Return H as the library computes it from what `reduction` leaves of the chain."""
    return energy(Chain(*numbers, *choose_ends(boundary, reduction)), pack(z, reduction))


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_energy_is_equation_8(boundary):
    for half_width, reduction in [(0, WHOLE), *itertools.product([1, 2, 7], REDUCTIONS)]:
        z = random_chain(half_width, **reduction._asdict())
        expected = pytest.approx(hamiltonian(z, CONSTANTS, boundary), rel=1e-13)
        found = library_energy(z, CONSTANTS, boundary, reduction)
        assert found == expected, (half_width, reduction)
