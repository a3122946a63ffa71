"""The explicit constants of Theorems 1 to 3, how near data come to their bounds, and Lemma 1."""

from dataclasses import replace

import numpy as np
import pytest
from oracle import slope
from pendula.models.bounds import (
    extent,
    proven_region,
    theorem_1_bound,
    theorem_2_constants,
    theorem_3_bound,
    widened_barrier,
    widened_bound,
    with_positive_coupling,
)
from pendula.models.linear_chain import finite_rate, gamma_0, growth_rate, infinite_rate
from pendula.studies.theory import claims_nonlinear, theorems
from pendula.studies.theory.equations import one_pair, total_energy
from pendula.studies.theory.stability import edge_wave
from pendula.studies.theory.theorems import check_sharpness, largest_of_energy
from problems import constants_of
from scipy.integrate import solve_ivp

NEGATIVE, POSITIVE = constants_of((1.0, 1.0, -4.0)), constants_of((1.0, 1.0, 8.0))
OTHER_CONSTANTS = ((0.5, 0.2, -1.0), (1.5, 2.0, -4.5), (0.3, 1.9, -4.0))
each_constants = pytest.mark.parametrize(
    "constants", [NEGATIVE, *map(constants_of, OTHER_CONSTANTS)]
)


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
        (-4.0, (0.75, 0.0), "dirichlet", "theorem 2"),
        (-4.0, (1.0, 0.1), "dirichlet", "theorem 2 widened"),
        (-4.0, (1.0, 0.1), "free", "none"),  # a constant there has no gradient
        (-4.0, (5.0, 1.0), "dirichlet", "none"),
        (0.0, (1.0, 0.1), "dirichlet", "none"),
    ],
)
def test_region_of_each_case(omega, pair, boundary, region):
    assert proven_region(*start_of(omega, pair), boundary) == region


def test_exact_values_of_the_bounds():
    assert extent(NEGATIVE) == 10.0
    assert theorem_1_bound(5.5, POSITIVE) == 2.75
    assert theorem_1_bound(-1.0, constants_of((1.0, 1.0, 6.0))) == np.inf
    assert theorem_2_constants(NEGATIVE) == (0.4, 10.0)
    assert theorem_3_bound(-1200.0 * (1 + 1e-9), 6, NEGATIVE) == 240.0
    assert theorem_3_bound(-1200.0 + 12.0 * 9.0, 6, NEGATIVE) == 24.0 * 13.0


@each_constants
def test_the_widened_bound_is_where_the_energy_allows_no_more(constants):
    """The depth a P - P^3 / (64 epsilon) of its P is the energy's, and its barrier is the top."""
    a = -constants.omega - 2.0 * constants.gamma
    powers = np.linspace(0.0, 2.0 * widened_barrier(constants)[0], 4001)
    depths = a * powers - powers**3 / (64.0 * constants.epsilon)
    top, barrier = widened_barrier(constants)
    assert (top, barrier) == pytest.approx((powers[depths.argmax()], depths.max()), rel=1e-3)
    for energy in (-0.01 * barrier, -0.99 * barrier):
        bound = widened_bound(energy, 0.0, constants)
        depth = a * bound - bound**3 / (64.0 * constants.epsilon)
        assert depth == pytest.approx(-energy) and bound < top
    assert widened_bound(-1.01 * barrier, 0.0, constants) == np.inf


@each_constants
def test_signs_that_a_change_of_variables_turns_do_not_matter(constants):
    """Amplitudes times i turn the sign of the drive, every second one times -1 that of epsilon."""
    negative = replace(constants, gamma=-constants.gamma)
    omega = constants.omega - 4.0 * constants.epsilon
    staggered = replace(constants, epsilon=-constants.epsilon, omega=omega)
    assert with_positive_coupling(staggered) == constants
    for bound in (widened_barrier, theorem_2_constants, extent):
        assert bound(negative) == bound(staggered) == bound(constants)


# --- What data reach ------------------------------------------------------------------------------


@pytest.mark.parametrize("sites", [3, 11])
def test_a_tiny_wave_reaches_what_the_linear_equations_say(monkeypatch, sites):
    """P grows from the wave's least to its largest value by (kappa + 2 gamma) / (kappa - 2 gamma).

    -H / P is kappa - 2 gamma where P is largest; at the other end of the band all signs turn.
    """
    monkeypatch.setattr(theorems, "LONG", sites)
    computed = {name: variable["data"] for name, variable in check_sharpness()["data_vars"].items()}
    kappa = 4.0 + 4.0 * np.sin(0.5 * np.pi / (sites + 1)) ** 2  # as far from the band at both Omega
    growth = (kappa + 2.0) / (kappa - 2.0)
    assert computed["reached"][:2] == pytest.approx(2 * [2 / (kappa - 2)], rel=1e-6)
    assert computed["least_constant"] == pytest.approx([growth, growth], rel=1e-6)
    assert computed["proof_constant"].tolist() == [5.0, 5.0]  # (8 + 2) / 2 and (4 + 2 + 4) / 2


@pytest.mark.parametrize(("theorem", "omega"), [(0, 8.0), (1, -4.0)])
def test_the_power_of_the_wave_grows_in_time_by_the_least_constant(monkeypatch, theorem, omega):
    """SciPy runs the equations from the wave with its least P."""
    sites = 11
    monkeypatch.setattr(theorems, "LONG", sites)
    constant = check_sharpness()["data_vars"]["least_constant"]["data"][theorem]
    start = 1e-4 * edge_wave(omega, sites)

    def rates(_, z):
        return slope(z.reshape(2, -1), (1.0, 1.0, omega), "dirichlet").ravel()

    run = solve_ivp(
        rates, (0.0, 2.0), start.ravel(), method="DOP853", rtol=1e-11, atol=1e-16, max_step=0.01
    )
    powers = (np.abs(run.y) ** 2).sum(axis=0)
    assert powers[0] == pytest.approx(powers.min())
    assert powers.max() / powers[0] == pytest.approx(constant, rel=1e-4)


def test_above_the_bottom_of_the_energy_a_rough_wave_comes_nearer_to_the_bound_of_theorem_3():
    """With x^2 = 60 on N sites P = 120 N. In H the ends cost 4 x^2 / N a site.

    Neighbours differ by 2 x, but the last ones differ from those at rest beyond the ends by x.
    """
    sites = theorems.LONG
    energy = (0.5 * 60.0**2 - 20.0 * 60.0) * sites + 4.0 * 60.0
    bound = 4.0 * sites * (10.0 + np.sqrt(100.0 + 0.5 * energy / sites))
    reached = check_sharpness()["data_vars"]["reached"]["data"][2]
    assert reached == pytest.approx(120.0 * sites / bound, rel=1e-12) and reached > 0.999


def test_a_share_of_a_bound_is_not_rounded_up_to_the_whole():
    constants = {
        f"{form}_constant_{theorem}": 3.0
        for form in claims_nonlinear.FORMS
        for theorem in claims_nonlinear.SIZES
    }
    words = claims_nonlinear._by_energy_alone(constants | {"by_energy_theorem_3": 0.999895})
    assert "at least 99.98% of each bound in terms of H is attained" in words


def test_the_largest_power_of_an_energy_has_that_energy():
    sites, energy = 7, -2.5
    power = largest_of_energy(constants_of((1.0, 1.0, 0.0)), sites, energy)
    wave = np.sqrt(0.5 * power / sites) * (-1.0) ** np.arange(sites)
    computed = total_energy(
        constants_of((1.0, 1.0, 0.0)), "dirichlet", np.stack([wave, -wave]) + 0j
    )
    assert computed == pytest.approx(energy)


# --- Lemma 1 --------------------------------------------------------------------------------------


@pytest.mark.parametrize("gamma", [0.3, 1.0, 2.5])
def test_the_infinite_rate_is_the_largest_over_all_waves_and_that_of_a_long_chain(gamma):
    omegas = np.array([-4.0, -1.0, 0.5, 3.0, 8.0])
    kappa = 4.0 * np.sin(np.linspace(0.0, np.pi, 4001) / 2) ** 2
    largest = growth_rate(kappa[:, None] - omegas, gamma).max(axis=0)
    np.testing.assert_allclose(infinite_rate(omegas, gamma, 1.0), largest, atol=1e-5)
    long = finite_rate(omegas, gamma, 1.0, 2001, "dirichlet")
    np.testing.assert_allclose(long, largest, atol=1e-4)


def test_gamma_0_is_half_of_the_distance_to_the_band():
    """The band of a negative coupling lies below zero."""
    np.testing.assert_array_equal(gamma_0(np.array([-4, 0, 2, 4, 5, 8]), 1.0), [2, 0, 0, 0, 0.5, 2])
    np.testing.assert_array_equal(gamma_0(np.array([-6, -4, -2, 0, 2]), -1.0), [1, 0, 0, 0, 1])
