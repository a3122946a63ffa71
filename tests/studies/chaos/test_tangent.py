"""The variational equations against differences of equation (4), and Lemma 1 as their limit."""

import numpy as np
import pytest
from oracle import BOUNDARIES, random_chain, slope
from pendula.models.amplitudes import Chain
from pendula.models.tangent import bundle_rates, tangent_rates
from pendula.simulation.lattice import Reduction, choose_ends, pack, unpack
from pendula.simulation.simulate import simulate
from pendula.studies.chaos.tangents import grow
from pendula.studies.theory.linear_stability import finite_rate
from problems import problem_from

CONSTANTS = (0.7, 1.3, -2.1)
WHOLE = Reduction(even=False, synchronised=False)
HALF = Reduction(even=True, synchronised=False)
DOP853 = {"name": "dop853", "rtol": 1e-12, "atol": 1e-14}


def tangent(z, change, boundary, reduction=WHOLE):
    """Return the rate of `change` at `z` as the library computes it."""
    chain = Chain(*CONSTANTS, *choose_ends(boundary, reduction))
    y, w = pack(z, reduction), pack(change, reduction)
    dw = np.zeros_like(w)
    tangent_rates(chain, y, w, dw)
    return unpack(dw, reduction)


def derivative(z, change, boundary, h=1e-5):
    """Return the derivative of equation (4) along `change` by a central difference."""
    ahead, behind = (slope(z + s * change, CONSTANTS, boundary) for s in (h, -h))
    return (ahead - behind) / (2 * h)


@pytest.mark.parametrize("reduction", [WHOLE, HALF])
@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("half_width", [1, 4])
def test_tangent_rates_are_differences_of_equation_4(half_width, boundary, reduction):
    z = 2 * random_chain(half_width, even=reduction.even, seed=1)
    change = random_chain(half_width, even=reduction.even, seed=2)
    expected = derivative(z, change, boundary)
    actual = tangent(z, change, boundary, reduction)
    np.testing.assert_allclose(actual, expected, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_an_odd_change_of_an_even_state_stays_odd_to_the_last_bit(boundary):
    z, change = random_chain(5, even=True), random_chain(5, seed=3)
    rate = tangent(z, change - change[:, ::-1], boundary)
    np.testing.assert_array_equal(rate, -rate[:, ::-1])


def test_a_bundle_carries_the_state_and_each_change():
    z, changes = random_chain(3), [random_chain(3, seed=seed) for seed in (1, 2)]
    chain = Chain(*CONSTANTS, *choose_ends("dirichlet", WHOLE))
    bundle = np.concatenate([pack(state, WHOLE) for state in (z, *changes)])
    slopes = np.zeros_like(bundle)
    bundle_rates(chain, bundle, slopes)
    states = [slope(z, CONSTANTS, "dirichlet"), *(tangent(z, c, "dirichlet") for c in changes)]
    actual = np.array([unpack(part, WHOLE) for part in np.split(slopes, 3)])
    np.testing.assert_allclose(actual, states, rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("omega", [-1.0, 0.0, 2.5])
def test_at_rest_a_change_grows_as_lemma_1_says(omega):
    rest, change = np.zeros((2, 7), complex), random_chain(3)[None]
    growth = grow(problem_from(rest, (1.0, 1.0, omega)), change, 60.0)
    rate = (growth.stretch[0, -1] - growth.stretch[0, 160]) / 20.0
    assert rate == pytest.approx(finite_rate(omega, 1.0, 1.0, 7, "dirichlet"), rel=2e-3)


def test_a_change_grows_like_the_distance_of_two_solutions():
    z, change, h = random_chain(3), random_chain(3, seed=4), 1e-6
    change /= np.linalg.norm(change)
    problem = problem_from(z, CONSTANTS, end_time=2.0, output_step=2.0, solver=DOP853)
    ends = [simulate(problem.changed(initial=z + s * change)).final for s in (h, -h)]
    distance = np.linalg.norm(ends[0] - ends[1]) / (2 * h)
    growth = grow(problem, change[None], 2.0, tolerance=1e-11)
    assert growth.stretch[0, -1] == pytest.approx(np.log(distance), abs=1e-7)
    both = np.linalg.norm((ends[0] + ends[1]) / 2)
    assert growth.size[-1] == pytest.approx(both, rel=1e-9)
