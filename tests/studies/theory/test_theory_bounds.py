"""The explicit constants of Theorems 1 to 3, and how they fit together."""

from dataclasses import astuple, replace

import numpy as np
import pytest
from pendula.models.bounds import (
    best_bound,
    coercivity,
    extent,
    lipschitz,
    proven_region,
    theorem_1_bound,
    theorem_2_bound,
    theorem_2_constants,
    theorem_3_bound,
    widened_barrier,
    widened_bound,
    widened_delta_0,
    with_positive_coupling,
)
from pendula.studies.theory.equations import one_pair, total_energy
from pendula.studies.theory.worst_data import ring_energy
from problems import constants_of

NEGATIVE = constants_of((1.0, 1.0, -4.0))
OTHERS = (
    (0.5, 0.2, -1.0),
    (1.5, 2.0, -4.5),
    (0.3, 1.9, -4.0),
    (1.0, 1.5, -4.0),  # the gap a is 2/3 of gamma, below 2/5 of it, and 1/2 of it:
    (1.0, 2.5, -6.0),  # the top of the barrier has another formula from 1/2 down, and at 1/2 both
    (1.0, 2.0, -5.0),
)
PARAMETERS = [NEGATIVE, *map(constants_of, OTHERS)]


def start_of(omega, pair):
    amplitudes = one_pair(61, pair)
    constants = constants_of((1.0, 1.0, omega))
    power = float(np.sum(np.abs(amplitudes) ** 2))
    return total_energy(constants, "dirichlet", amplitudes), power, constants


@pytest.mark.parametrize(
    ("omega", "pair", "region"),
    [
        (8.0, (1.0, 0.1), "theorem 1"),
        (8.0, (5.0, 1.0), "theorem 1"),
        (-4.0, (0.3, 0.1), "theorem 2"),
        (-4.0, (0.75, 0.0), "theorem 2 by its energy"),
        (-4.0, (1.0, 0.1), "theorem 2 widened"),
        (-4.0, (5.0, 1.0), "none"),
        (0.0, (1.0, 0.1), "none"),
    ],
)
def test_region_of_each_case(omega, pair, region):
    energy, power, constants = start_of(omega, pair)
    assert proven_region(energy, power, constants, "dirichlet") == region


def test_the_region_of_theorem_2_ends_at_its_radius():
    inside, beyond = (proven_region(-1.0, start, NEGATIVE, "dirichlet") for start in (0.399, 0.4))
    assert (inside, beyond) == ("theorem 2", "theorem 2 by its energy")
    assert proven_region(0.0, 0.0, NEGATIVE, "dirichlet") == "theorem 2 by its energy"


def test_widening_does_not_hold_where_a_constant_has_no_gradient():
    energy, power, constants = start_of(-4.0, (1.0, 0.1))
    assert proven_region(energy, power, constants, "free") == "none"
    flat = np.array([[0.2j], [-0.2j]]) * np.ones(101)
    depth = -total_energy(NEGATIVE, "free", flat)
    assert depth < coercivity(np.sum(np.abs(flat) ** 2), NEGATIVE) + 4.0


@pytest.mark.parametrize("constants", PARAMETERS)
def test_theorem_2_covers_its_whole_ball(constants):
    delta_0, c_0 = theorem_2_constants(constants)
    for delta in delta_0 * np.array([1e-6, 0.1, 0.5, 0.999]):
        deepest = -extent(constants) * delta
        assert theorem_2_bound(deepest, delta, constants) <= c_0 * delta * (1 + 1e-12)


@pytest.mark.parametrize("constants", PARAMETERS)
def test_barrier_is_the_maximum_of_the_coercivity(constants):
    power = np.linspace(1e-3, 30.0, 300001)
    top, barrier = widened_barrier(constants)
    heights = coercivity(power, constants)
    assert barrier == pytest.approx(heights.max(), rel=1e-8)
    assert top == pytest.approx(power[np.argmax(heights)], abs=1e-3)
    assert coercivity(widened_bound(-0.5 * barrier, 0.1, constants), constants) == pytest.approx(
        0.5 * barrier
    )


@pytest.mark.parametrize("constants", PARAMETERS)
def test_coercivity_takes_the_worst_split_between_a_and_b(constants):
    epsilon, gamma, omega = astuple(constants)
    angle = np.linspace(0.0, np.pi / 4, 20001)
    for power in (0.5, 3.0, 7.0, 12.0):
        p, q = power * np.cos(angle) ** 2, power * np.sin(angle) ** 2
        split = abs(omega) * power - gamma * (np.sqrt(p) + np.sqrt(q)) ** 2
        split = split - (p**3 + q**3) / (64 * epsilon)
        assert coercivity(power, constants) == pytest.approx(split.min(), abs=1e-6)


def test_searches_reach_the_value_of_tiny_data_or_more(numbers):
    ratio = numbers("worst", "worst") / numbers("worst", "small_data")
    assert (ratio[numbers("worst", "searched_family") != "theorem_3"] > 1.0 - 1e-6).all()


def test_the_ratio_of_theorem_3_grows_with_the_size_of_data_and_tends_to_one():
    """So its search needs a limit on P."""
    rng = np.random.default_rng(6)
    drawn = rng.normal(size=(40, 2, 3)) + 1j * rng.normal(size=(40, 2, 3))
    for shape in (*drawn, drawn[0] / np.abs(drawn[0])):
        data = [size * shape for size in 2.0 ** np.arange(-3.0, 14.0)]
        powers = np.array([np.sum(np.abs(z) ** 2) for z in data])
        energies = np.array([total_energy(NEGATIVE, "dirichlet", z) for z in data])
        reached = powers / theorem_3_bound(energies, 3, NEGATIVE)
        assert np.all(np.diff(reached) > 0.0)
    assert reached[-1] == pytest.approx(1.0, abs=1e-5)


def test_the_worst_data_for_theorem_3_are_real_and_alternate(numbers):
    """A = -B = (x, -y, x), searched on two numbers, gives what the search on thirteen finds."""
    x, y = np.meshgrid(np.linspace(5.0, 7.0, 401), np.linspace(5.0, 7.5, 501))
    power = 2.0 * (2.0 * x * x + y * y)
    bonds = 2.0 * (2.0 * x * x + 2.0 * (x + y) ** 2)
    energy = 0.5 * (2.0 * x**4 + y**4) - 4.0 * power - 2.0 * power - bonds
    ratio = np.where(power <= 240.0, power / theorem_3_bound(energy, 3, NEGATIVE), 0.0)
    asked = list(numbers("worst", "question", "coords"))
    found = numbers("worst", "worst")[asked.index("theorem_3, dirichlet")]
    assert found - 2e-3 < ratio.max() <= found + 1e-9


@pytest.mark.parametrize("power", [1e-6, 0.1, 0.9, 3.0])
def test_a_widened_bound_is_where_the_coercivity_reaches_the_energy(power):
    energy = -coercivity(power, NEGATIVE)
    assert widened_bound(energy, 0.5 * power, NEGATIVE) == pytest.approx(power, rel=1e-9)


def test_exact_values_of_the_bounds():
    assert (extent(NEGATIVE), lipschitz(NEGATIVE, 2.0)) == (10.0, 16.0)
    assert theorem_1_bound(5.5, constants_of((1.0, 1.0, 8.0))) == 2.75
    assert theorem_1_bound(1.0, constants_of((1.0, 1.0, 6.5))) == 2.0
    assert theorem_1_bound(-1.0, constants_of((1.0, 1.0, 6.0))) == np.inf
    assert theorem_2_constants(NEGATIVE) == (0.4, 10.0)
    assert theorem_3_bound(-1200.0 * (1 + 1e-9), 6, NEGATIVE) == 240.0
    assert theorem_3_bound(-1200.0 + 12.0 * 9.0, 6, NEGATIVE) == 24.0 * 13.0
    bounds = [theorem_3_bound(-10.0, n, NEGATIVE) for n in (1, 11, 61, 401)]
    assert np.all(np.diff(bounds) > 0)
    assert widened_barrier(NEGATIVE) == pytest.approx((8.394, 13.399), abs=1e-3)
    assert widened_delta_0(NEGATIVE) == pytest.approx(1.340, abs=1e-3)


def test_theorem_2_ends_at_its_barrier():
    """At Omega = -5 it covers P(0) < 6 with -H < 9, where P stays below 6; not the edges."""
    constants = constants_of((1.0, 1.0, -5.0))
    assert theorem_2_bound(-8.91, 5.9, constants) == pytest.approx(5.4)
    assert theorem_2_bound(-6.75, 0.1, constants) == pytest.approx(3.0)
    for energy, start in ((-6.75, 6.0), (-9.0, 0.1), (-10.0, 0.1), (-6.75, 7.0)):
        assert theorem_2_bound(energy, start, constants) == np.inf
    for numbers in ((0.0, 1.0, -4.0), (1.0, 0.0, 4.0), (1.0, 1.0, -2.0)):
        assert widened_barrier(constants_of(numbers)) == (0.0, 0.0)
    assert min(widened_barrier(constants_of((1.0, 1.0, -3.0)))) > 1.0  # the gap is one


def test_the_best_bound_knows_the_ends():
    energy, power, constants = start_of(-4.0, (1.0, 0.1))
    closed, free = (
        best_bound(energy, power, 61, constants, ends) for ends in ("dirichlet", "free")
    )
    assert closed == widened_bound(energy, power, constants) == pytest.approx(3.3858, abs=1e-4)
    assert free == theorem_3_bound(energy, 61, constants) > 4000.0
    assert best_bound(5.5, 1.01, 61, constants_of((1.0, 1.0, 8.0)), "free") == 2.75


@pytest.mark.parametrize("constants", PARAMETERS)
def test_signs_that_a_change_of_variables_turns_do_not_matter(constants):
    """Amplitudes times i turn the sign of the drive, every second one times -1 that of epsilon."""
    other = replace(constants, gamma=-constants.gamma)
    omega = constants.omega - 4.0 * constants.epsilon
    staggered = replace(constants, epsilon=-constants.epsilon, omega=omega)
    assert with_positive_coupling(staggered) == constants
    for bound in (widened_barrier, theorem_2_constants, extent):
        assert bound(other) == bound(staggered) == bound(constants)
    assert theorem_1_bound(1.0, constants_of((-1.0, 1.0, 4.0))) == 0.5


def test_theorem_3_is_attained_on_a_ring_by_an_energy_written_apart(numbers):
    assert numbers("worst", "attained") == pytest.approx(1.0)
    z = np.random.default_rng(3).normal(size=(2, 5)) + 0.3j
    assert ring_energy(NEGATIVE, z) == pytest.approx(total_energy(NEGATIVE, "periodic", z))
