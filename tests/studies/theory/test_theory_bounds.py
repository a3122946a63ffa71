"""The explicit constants of Theorems 1 to 3, and how near data come to their bounds."""

from dataclasses import astuple, replace

import numpy as np
import pytest
from pendula.models.bounds import (
    coercivity,
    extent,
    lipschitz,
    proven_region,
    theorem_1_bound,
    theorem_2_constants,
    theorem_3_bound,
    widened_barrier,
    widened_delta_0,
    with_positive_coupling,
)
from pendula.studies.theory.equations import one_pair, total_energy
from pendula.studies.theory.sharpness import reached
from problems import constants_of

NEGATIVE, POSITIVE = constants_of((1.0, 1.0, -4.0)), constants_of((1.0, 1.0, 8.0))
OTHERS = (
    (0.5, 0.2, -1.0),
    (1.5, 2.0, -4.5),
    (0.3, 1.9, -4.0),
    (1.0, 1.5, -4.0),  # the gap a is 2/3 of gamma, below 2/5 of it, and 1/2 of it:
    (1.0, 2.5, -6.0),  # the top of the barrier has another formula from 1/2 down, and at 1/2 both
    (1.0, 2.0, -5.0),
)
each_constants = pytest.mark.parametrize("constants", [NEGATIVE, *map(constants_of, OTHERS)])


def start_of(omega, pair):
    amplitudes = one_pair(61, pair)
    constants = constants_of((1.0, 1.0, omega))
    power = float(np.sum(np.abs(amplitudes) ** 2))
    return total_energy(constants, "dirichlet", amplitudes), power, constants


@pytest.mark.parametrize(
    ("omega", "pair", "boundary", "region"),
    [
        (8.0, (1.0, 0.1), "dirichlet", "theorem 1"),
        (8.0, (5.0, 1.0), "dirichlet", "theorem 1"),
        (-4.0, (0.3, 0.1), "dirichlet", "theorem 2"),
        (-4.0, (0.75, 0.0), "dirichlet", "theorem 2 by its energy"),
        (-4.0, (1.0, 0.1), "dirichlet", "theorem 2 widened"),
        (-4.0, (1.0, 0.1), "free", "none"),  # a constant there has no gradient
        (-4.0, (5.0, 1.0), "dirichlet", "none"),
        (0.0, (1.0, 0.1), "dirichlet", "none"),
    ],
)
def test_region_of_each_case(omega, pair, boundary, region):
    assert proven_region(*start_of(omega, pair), boundary) == region


@each_constants
def test_coercivity_takes_the_worst_split_between_a_and_b(constants):
    epsilon, gamma, omega = astuple(constants)
    angle = np.linspace(0.0, np.pi / 4, 20001)
    for power in (0.5, 3.0, 7.0, 12.0):
        p, q = power * np.cos(angle) ** 2, power * np.sin(angle) ** 2
        split = abs(omega) * power - gamma * (np.sqrt(p) + np.sqrt(q)) ** 2
        split = split - (p**3 + q**3) / (64 * epsilon)
        assert coercivity(power, constants) == pytest.approx(split.min(), abs=1e-6)


def test_exact_values_of_the_bounds():
    assert (extent(NEGATIVE), lipschitz(NEGATIVE, 2.0)) == (10.0, 16.0)
    assert theorem_1_bound(5.5, POSITIVE) == 2.75
    assert theorem_1_bound(-1.0, constants_of((1.0, 1.0, 6.0))) == np.inf
    assert theorem_2_constants(NEGATIVE) == (0.4, 10.0)
    assert proven_region(-1.0, 0.399, NEGATIVE, "dirichlet") == "theorem 2"
    assert proven_region(-1.0, 0.4, NEGATIVE, "dirichlet") == "theorem 2 by its energy"
    assert theorem_3_bound(-1200.0 * (1 + 1e-9), 6, NEGATIVE) == 240.0
    assert theorem_3_bound(-1200.0 + 12.0 * 9.0, 6, NEGATIVE) == 24.0 * 13.0
    assert widened_barrier(NEGATIVE) == pytest.approx((8.394, 13.399), abs=1e-3)
    assert widened_delta_0(NEGATIVE) == pytest.approx(1.340, abs=1e-3)


@each_constants
def test_signs_that_a_change_of_variables_turns_do_not_matter(constants):
    """Amplitudes times i turn the sign of the drive, every second one times -1 that of epsilon."""
    other = replace(constants, gamma=-constants.gamma)
    omega = constants.omega - 4.0 * constants.epsilon
    staggered = replace(constants, epsilon=-constants.epsilon, omega=omega)
    assert with_positive_coupling(staggered) == constants
    for bound in (widened_barrier, theorem_2_constants, extent):
        assert bound(other) == bound(staggered) == bound(constants)
    assert theorem_1_bound(1.0, constants_of((-1.0, 1.0, 4.0))) == 0.5


# --- What data reach ------------------------------------------------------------------------------


@pytest.mark.parametrize("sites", [3, 11])
def test_a_tiny_wave_reaches_what_the_linear_equations_say(sites):
    """P grows from the wave's least to its largest value by (kappa + 2 gamma) / (kappa - 2 gamma).

    -H / P is kappa - 2 gamma where P is largest; at the other end of the band all signs turn.
    """
    edge = 4.0 * np.sin(0.5 * np.pi / (sites + 1)) ** 2
    kappa = 4.0 + edge  # of both: Omega = -4 and 8 lie as far from the band
    assert reached("theorem_1", POSITIVE, sites) == pytest.approx(2.0 / (kappa - 2.0), rel=1e-6)
    assert reached("theorem_2", NEGATIVE, sites) == pytest.approx(2.0 / (kappa - 2.0), rel=1e-6)
    growth = (kappa + 2.0) / (kappa - 2.0)
    assert reached("theorem_2_ball", NEGATIVE, sites) == pytest.approx(growth / 5.0, rel=1e-6)
