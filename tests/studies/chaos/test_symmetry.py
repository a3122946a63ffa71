"""Lost evenness: an arithmetic that is not even, and odd parts that grow as the tangents say."""

import numpy as np
import pytest
from oracle import BOUNDARIES, random_chain, slope
from pendula.models.amplitudes import Chain
from pendula.simulation.lattice import Reduction, choose_ends, pack, unpack
from pendula.studies.chaos import lopsided as arithmetic
from pendula.studies.chaos import symmetry
from pendula.studies.chaos.lyapunov import random_tangent
from pendula.studies.chaos.tangent_dynamics import follow_odd_part, grow
from problems import problem_of

CONSTANTS = (0.7, 1.3, -2.1)
WHOLE = Reduction(even=False, synchronised=False)


def problem(case, **changes):
    return problem_of(case, **{"half_width": 10, "end_time": 6.0, "output_step": 0.25} | changes)


def lopsided(z, boundary):
    y = pack(z, WHOLE)
    dy = np.zeros_like(y)
    arithmetic.lopsided_rates(Chain(*CONSTANTS, *choose_ends(boundary, WHOLE)), y, dy)
    return unpack(dy, WHOLE)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_the_lopsided_rates_are_equation_4(boundary):
    z = random_chain(4)
    expected = slope(z, CONSTANTS, boundary)
    np.testing.assert_allclose(lopsided(z, boundary), expected, rtol=1e-13, atol=1e-13)


def test_the_lopsided_rates_of_even_data_are_even_but_for_rounding():
    rate = lopsided(random_chain(30, even=True), "dirichlet")
    assert 0 < np.abs(rate - rate[:, ::-1]).max() < 1e-13


def test_the_odd_part_is_measured_relative_to_the_whole():
    even, odd = random_chain(3, even=True), random_chain(3, seed=1)
    odd = odd - odd[:, ::-1]
    sizes = [arithmetic.odd_part(pack(z, WHOLE)) for z in (even, odd, even + 0.5 * odd)]
    mixed = 0.5 * np.linalg.norm(odd) / np.linalg.norm(even + 0.5 * odd)
    np.testing.assert_allclose(sizes, [0.0, 1.0, mixed], rtol=1e-13)


def test_an_odd_perturbation_grows_as_the_tangent_dynamics_says():
    case, size = problem("fig4_small"), 1e-7
    vector = random_tangent(21, "odd", np.random.default_rng(0))
    vector *= size / np.linalg.norm(vector)
    odd = follow_odd_part(case, case.amplitudes + vector, 0.25, 1e-12)
    growth = grow(case, vector[None], 6.0)
    expected = size * np.exp(growth.log_growth[0]) / growth.size
    np.testing.assert_allclose(odd, expected, rtol=2e-3)


def test_evenness_is_lost_by_rounding_where_the_chain_is_chaotic_only():
    cases = (problem(name, end_time=12.0) for name in ("fig4_small", "fig3_small"))
    chaotic, regular = (follow_odd_part(case, case.amplitudes, 0.25, 1e-12) for case in cases)
    assert chaotic[0] == regular[0] == 0.0
    assert regular[-1] < 1e-13 < 1e-11 < chaotic[-1]


def test_members_are_perturbed_by_the_required_size_and_seeded():
    case = problem("fig3_small", end_time=1.0)
    (_, one), (_, same), (_, other) = (
        symmetry.break_symmetry(case, 1e-6, 2, seed) for seed in (1, 1, 2)
    )
    np.testing.assert_allclose(one[:, 0], 1e-6, rtol=1e-6)
    np.testing.assert_array_equal(one, same)
    assert not np.array_equal(one, other) and not np.array_equal(*one)
