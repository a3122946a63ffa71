"""The next order of the expansion beside its formulas, and the laws that its arithmetic keeps.

The formulas themselves are derived from Newton's equations in tests/derivation.
"""

import numpy as np
import pytest
from latticode.simulation.lattice import Reduction, choose_ends, pack, unpack
from oracle import random_chain
from pendula.models import amplitudes, expansion
from pendula.models.amplitudes import Chain

CONSTANTS = (0.7, 1.3, -2.1)
SQUARED_MU = 0.04
WHOLE = Reduction(even=False, synchronised=False)


def library_rates(z, boundary="dirichlet", squared_mu=SQUARED_MU, reduction=WHOLE):
    """Return dA/dtau and dB/dtau to the next order as the kernel finds them."""
    chain = Chain(*CONSTANTS, *choose_ends(boundary, reduction))
    y = pack(z, reduction)
    room, dy = np.zeros((2, *y.shape)), np.zeros_like(y)
    expansion.rates(expansion.Expansion(chain, squared_mu, *room), y, dy)
    return unpack(dy, reduction)


def test_without_the_next_order_the_rates_are_those_of_equation_4():
    z = random_chain(5)
    chain = Chain(*CONSTANTS, *choose_ends("dirichlet", WHOLE))
    y = pack(z, WHOLE)
    dy = np.zeros_like(y)
    amplitudes.rates(chain, y, dy)
    np.testing.assert_array_equal(library_rates(z, squared_mu=0.0), unpack(dy, WHOLE))


@pytest.mark.parametrize("reduction", [Reduction(True, False), Reduction(False, True)])
def test_half_of_a_chain_and_one_component_have_the_bits_of_the_whole(reduction):
    z = random_chain(6, **reduction._asdict())
    np.testing.assert_array_equal(library_rates(z, reduction=reduction), library_rates(z))
