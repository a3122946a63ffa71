"""The next order of the expansion beside its formulas, and the laws that its arithmetic keeps.

The formulas themselves are derived from Newton's equations in tests/derivation.
"""

import numpy as np
import pytest
from oracle import BOUNDARIES, random_chain, slope
from pendula.models import amplitudes, expansion
from pendula.models.amplitudes import Chain
from pendula.simulation.lattice import Reduction, choose_ends, pack, unpack

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


def stated_rates(z, boundary):
    """Return -i (F + mu^2 G) by the formulas; A'' by differences of the flow of (4)."""
    _, gamma, omega = CONSTANTS
    first, h = slope(z, CONSTANTS, boundary), 1e-4
    ahead, behind = (slope(z + sign * h * first, CONSTANTS, boundary) for sign in (1, -1))
    second = (ahead - behind) / (2 * h)
    third = -(z**3 / 6 + gamma * (z[::-1] - z)) / 8
    g = -omega * (1j * first) / 2 - second / 4 + np.conj(z) ** 2 * third / 2
    g += -(np.abs(z) ** 4) * z / 12 + gamma * (third[::-1] - third)
    return first - 1j * SQUARED_MU * g


def angles(mu, z, phases, third=1.0):
    """Return the angles (time, component, site) of amplitudes `z` where omega t is `phases`."""
    found, partners = np.empty(z.shape), z[..., ::-1, :]
    for place in np.ndindex(z.shape):
        e, one, other = np.exp(1j * phases[place[0]]), z[place], partners[place]
        turn = e.real, e.imag, (e**3).real, (e**3).imag
        parts = one.real, one.imag, other.real, other.imag
        found[place] = expansion.angle(mu, CONSTANTS[1], third, turn, *parts)
    return found


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("half_width", [1, 6])
def test_the_rates_are_those_of_the_formulas(half_width, boundary):
    z = random_chain(half_width)
    np.testing.assert_allclose(
        library_rates(z, boundary), stated_rates(z, boundary), rtol=1e-6, atol=1e-7
    )


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


def test_the_corrected_start_has_the_angles_of_the_data():
    """What is left of x - 2 mu Re a is of the order mu^5: nothing but mu^3 P at the moved A."""
    z = random_chain(2)
    chain = Chain(*CONSTANTS, *choose_ends("dirichlet", WHOLE))
    left = []
    for mu in (0.1, 0.05):
        started = unpack(expansion.corrected_start(chain, mu * mu, pack(z, WHOLE)), WHOLE)
        started = angles(mu, started[None], np.zeros(1))[0]
        left.append(np.abs(started - 2 * mu * z.real).max())
    assert left[0] / left[1] == pytest.approx(2.0**5, rel=0.05)


def test_angles_are_the_real_parts_of_both_harmonics():
    mu, phases, z = 0.3, np.array([0.4, 2.0]), np.array([random_chain(1), random_chain(1, seed=3)])
    turn = np.exp(1j * phases)[:, None, None]
    third = -(z**3 / 6 + 1.3 * (z[:, ::-1] - z)) / 8
    leading = 2 * (mu * z * turn).real
    np.testing.assert_allclose(angles(mu, z, phases, 0.0), leading, rtol=1e-13)
    np.testing.assert_allclose(
        angles(mu, z, phases), leading + 2 * (mu**3 * third * turn**3).real, rtol=1e-12, atol=1e-15
    )
