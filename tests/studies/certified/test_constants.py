"""Balls with doubles around them, and constants in balls: around what `models` computes."""

import math
from fractions import Fraction

import numpy as np
import pytest
from flint import arb
from pendula.models import bounds, linear_chain
from pendula.problem import Constants
from pendula.studies.certified import balls, constants
from pendula.studies.certified.constants import Parameters, farthest
from pendula.studies.theory import errata
from pendula.studies.theory.equations import total_energy
from problems import make_problem

HERE = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
OTHERS = [HERE, Constants(epsilon=0.7, gamma=-0.3, omega=-2.2),
          Constants(epsilon=-0.4, gamma=0.3, omega=-4.1)]  # fmt: skip


@pytest.fixture(autouse=True)
def precision():
    with balls.precision():
        yield


@pytest.mark.parametrize("value", [0.1, -0.1, 1 / 3, 5.0, 1e-300, -1e300])
def test_ends_are_doubles_on_the_outer_side(value):
    third, exact = arb(value) / 3, Fraction(value) / 3
    assert Fraction(balls.lower(third)) <= exact <= Fraction(balls.upper(third))
    assert balls.upper(third) <= math.nextafter(balls.lower(third), math.inf)
    assert balls.lower(arb(value)) == balls.upper(arb(value)) == value


def test_a_radius_is_kept_and_what_is_not_finite_has_no_end():
    ball = balls.within(1.0, 1e-10)
    assert ball.contains(arb(1.0) + arb(1e-10)) and balls.lower(ball) <= 1.0 - 1e-10
    assert balls.upper(arb.pos_inf()) == math.inf and balls.lower(arb.nan()) == -math.inf


def near(ball, value, within=1e-13):
    return farthest(ball, float(value)) < within and balls.upper(ball.rad()) < 1e-25


@pytest.mark.parametrize("k", OTHERS)
@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_the_energy_is_that_of_the_kernels(k, boundary):
    rng = np.random.default_rng(5)
    data = rng.normal(size=(2, 7)) + 1j * rng.normal(size=(2, 7))
    assert near(constants.energy(Parameters.of(k), boundary, data), total_energy(k, boundary, data))


@pytest.mark.parametrize("k", OTHERS)
def test_bounds_of_a_case_are_those_of_the_models(k):
    problem = make_problem(np.array([[0, 0.3, 0], [0, 0.1j, 0]]), k, half_width=5)
    found = {one.variable: one.ball for one in constants.of_cases({"mine": problem})}
    h, start = total_energy(k, "dirichlet", problem.amplitudes), 0.1
    delta_0, c_0 = bounds.theorem_2_constants(k)
    expected = {
        "energy": h, "start": start, "delta_0": delta_0, "c_0": c_0,
        "theorem_3": bounds.theorem_3_bound(h, 11, k), "widened": bounds.widened_bound(h, start, k),
    }  # fmt: skip
    assert found.keys() == expected.keys()
    assert all(near(found[name], value) for name, value in expected.items())


def test_theorem_1_needs_its_range():
    for omega, covered in ((6.5, True), (6.0, False)):
        given = make_problem(np.array([[1.0], [0.1]]), (1, 1, omega))
        names = {one.variable for one in constants.of_cases({"mine": given})}
        assert ("theorem_1" in names) == covered


@pytest.mark.parametrize("omega", [-4.0, 0.0, 1.3, 2.0, 5.5])
@pytest.mark.parametrize("epsilon", [1.0, -0.5])
def test_thresholds_are_those_of_the_linear_chain(omega, epsilon):
    k = Parameters.of(Constants(epsilon=epsilon, gamma=0.0, omega=omega))
    finite = linear_chain.finite_threshold(np.array([omega]), epsilon, 21, "dirichlet")[0]
    assert near(constants.threshold(k, 21), finite)
    assert near(constants.threshold(k, None), linear_chain.gamma_0(omega, epsilon))


def test_the_root_lies_where_the_bound_reaches_the_depth():
    k, depth = Parameters.of(HERE), balls.decimal(6.619975)
    root = constants.widened(k, depth)
    below, above = (constants.coercivity(k, arb(f * root.mid())) for f in (0.999, 1.001))
    assert below < depth < above
    assert constants.widened(k, balls.decimal(13.5)) is None  # above the barrier of 13.4


def test_the_printed_bound_fails_from_three_sites_on():
    found = constants.of_printed_constant(HERE, 0.1, 5)
    stored = errata.check_theorem_3_constant(HERE, 0.1, 5)["data_vars"]
    for one in found:
        values = stored[one.variable]["data"]
        value = values if values.ndim == 0 else values[(one.of["sites"] - 1) // 2]
        assert near(one.ball, value), one.label
    assert found[-1].variable == "smallest" and found[-1].ball == 3


def test_a_tenth_is_not_the_double_next_to_it():
    data = np.array([[0.1 + 0j], [0j]])
    assert farthest(constants.power(data), 0.1 * 0.1) > 0.0
    assert constants.power(data).contains(arb(1) / 100)


def test_a_wrong_number_is_far_and_a_small_constant_is_held_to_an_absolute_distance():
    for stored in (1.01 * 4.0, np.nan, np.inf, -4.0):
        assert farthest(arb(4), stored) > 0.009
    assert farthest(arb(0), 2e-16) == pytest.approx(2e-16, rel=1e-9)
    assert farthest(arb(1000), 1001.0) == pytest.approx(1e-3, rel=1e-9)
