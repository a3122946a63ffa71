"""Lyapunov exponents and divergence times: what any Hamiltonian flow promises, and exact growth."""

import numpy as np
import pytest
from pendula.measures.confidence import Limits
from pendula.measures.growth import is_chaotic, mean_rate, mean_rate_error
from pendula.studies.chaos import lyapunov
from pendula.studies.chaos.lyapunov import PARITIES, random_tangent
from pendula.studies.chaos.tangent_dynamics import grow
from problems import problem_of

SEED = 20170817


@pytest.fixture(scope="module")
def whole_spectrum():
    return lyapunov.follow_many(problem_of("fig3_large", half_width=1), 12, 200.0, SEED)


def test_the_spectrum_is_that_of_a_hamiltonian_flow(whole_spectrum):
    """Exponents sum to zero at every time, come in pairs of opposite sign, and two vanish."""
    np.testing.assert_allclose(whole_spectrum.log_growth.sum(axis=0), 0.0, atol=1e-5)
    rates = mean_rate(whole_spectrum.tau, whole_spectrum.log_growth, 50.0)
    assert rates[0] > 0.3
    np.testing.assert_allclose(rates, -rates[::-1], atol=0.05)
    np.testing.assert_allclose(rates[5:7], 0.0, atol=0.05)


def test_the_limits_of_a_spectrum_are_those_of_eight_parts_of_the_time(whole_spectrum):
    found = lyapunov.spectrum_of(whole_spectrum, 50.0)
    tau, growth = whole_spectrum.tau, whole_spectrum.log_growth
    np.testing.assert_array_equal(found.value, mean_rate(tau, growth, 50.0))
    off = 2.36462 * mean_rate_error(tau, growth, 50.0)  # Student's t of seven degrees of freedom
    np.testing.assert_allclose([found.value - found.low, found.high - found.value], [off, off])


def test_the_lower_half_of_a_spectrum_has_the_opposite_signs():
    upper = Limits(np.array([2.0, 0.5]), np.array([1.5, -0.1]), np.array([2.5, 1.1]))
    found = lyapunov.in_pairs(upper)
    np.testing.assert_array_equal(found.value, [2.0, 0.5, -0.5, -2.0])
    np.testing.assert_array_equal(found.low, [1.5, -0.1, -1.1, -2.5])
    np.testing.assert_array_equal(found.high, [2.5, 1.1, 0.1, -1.5])


def test_half_of_the_exponents_are_those_of_the_whole_spectrum():
    problem = problem_of("fig3_large", half_width=1)
    half, whole = (lyapunov.follow_many(problem, n, 4.0, SEED, tolerance=1e-13) for n in (6, 12))
    np.testing.assert_allclose(half.log_growth, whole.log_growth[:6], atol=1e-8)


def test_published_spectra_are_those_of_each_short_chain_and_of_the_shortest_without_a_drive():
    problem = problem_of("fig3_large")
    made = lyapunov.spectra({"one": problem}, {1: 20.0, 2: 8.0}, 12.0, SEED)
    for key, row, half_width, end, gamma in (
        ("", 0, 1, 20.0, 1.0),
        ("", 1, 2, 8.0, 1.0),
        ("_undriven", ..., 1, 12.0, 0.0),
    ):
        short = problem.changed(half_width=half_width, gamma=gamma)
        half = lyapunov.follow_many(short, 2 * short.sites, end, SEED, tolerance=1e-12)
        one = lyapunov.in_pairs(lyapunov.spectrum_of(half, end / 4))
        rest = np.full(20 - len(one.value), np.nan)
        for name, values in (("exponents", one.value), ("exponents_error", one.half)):
            np.testing.assert_array_equal(made[f"{name}{key}"].values[0][row], [*values, *rest])
        if gamma:
            vanishing = np.sum((one.low <= 0.0) & (one.high >= 0.0))
            assert made["vanishing"].values[0, row] == vanishing > 0


@pytest.mark.parametrize("parity", PARITIES)
@pytest.mark.parametrize(
    ("case", "exponent", "off", "chaotic"),
    [("fig4_small", 1.7, 0.35, True), ("fig3_small", 0.0, 0.02, False)],
)
def test_the_chain_is_chaotic_at_omega_zero_and_regular_at_minus_four(
    case, exponent, off, chaotic, parity
):
    growth = lyapunov.follow_parity(problem_of(case, half_width=15), parity, 60.0, SEED)
    rate = mean_rate(growth.tau, growth.log_growth, 20.0)[0]
    assert rate == pytest.approx(exponent, abs=off)
    assert is_chaotic(growth.tau, growth.log_growth[0], growth.size) == chaotic


@pytest.mark.parametrize("parity", PARITIES)
@pytest.mark.parametrize("site", [0, 1])
def test_the_vectors_are_drawn_by_one_seed_and_the_place_of_their_parity(parity, site):
    """Along data that are not even the whole chain is followed."""
    problem = problem_of("fig3_small", half_width=2, initial={site: (1.0, 0.1)})
    vector = random_tangent(5, parity, np.random.default_rng([SEED, PARITIES.index(parity)]))
    known = grow(problem, vector[None], 1.0, even=parity == "even" and site == 0)
    found = lyapunov.follow_parity(problem, parity, 1.0, SEED)
    np.testing.assert_array_equal(found.log_growth, known.log_growth)


# --- Divergence -----------------------------------------------------------------------------------

TAU = np.linspace(0.0, 20.0, 1001)


@pytest.mark.parametrize(
    ("rate", "size", "expected"),
    [
        (1.5, np.ones_like(TAU), np.log(np.expm1(1.5 * TAU[5:]) / 1.5)),
        (1.5, np.exp(1.5 * TAU), np.log(TAU[5:])),  # the solution grows like its errors
    ],
)
def test_errors_made_all_along_grow_to_their_integral(rate, size, expected):
    log = lyapunov.amplification(TAU, rate * TAU, size)
    np.testing.assert_allclose(log[5:], expected, atol=0.02)


def test_a_thousandth_of_the_error_diverges_later_by_its_logarithm_over_the_rate():
    log = lyapunov.amplification(TAU, 2.0 * TAU, np.ones_like(TAU))
    early, late = (lyapunov.predict(TAU, log, error) for error in (1e-6, 1e-9))
    assert late - early == pytest.approx(np.log(1e3) / 2.0, abs=0.02)
    assert lyapunov.predict(TAU, np.zeros_like(TAU), 1e-6) == np.inf


def test_chaotic_runs_diverge_when_predicted_and_regular_ones_do_not():
    changes = {"half_width": 4, "end_time": 16.0, "output_step": 0.25}
    cases = {name: problem_of(name, **changes) for name in ("fig3_small", "fig4_large")}
    growth, _ = lyapunov.largest_exponents(cases, 16.0, SEED)
    assert growth["chaotic"].values.tolist() == [0, 1]
    found = lyapunov.divergence_times(cases, [1e-4, 1e-7], growth)
    regular, chaotic = found["divergence_predicted"].values
    assert np.isinf(regular).all() and np.isinf(found["divergence_measured"].values[0]).all()
    assert chaotic[0] < chaotic[1] < found["divergence_rounding"].values[1]
    np.testing.assert_allclose(found["divergence_measured"].values[1], chaotic, atol=3.0)
    one = lyapunov.follow_parity(cases["fig4_large"], "odd", 16.0, SEED, tolerance=1e-12)
    np.testing.assert_array_equal(growth["log_growth"].values[1, 1], one.log_growth[0])
    for name, reduce in (("exponent", mean_rate), ("exponent_error", mean_rate_error)):
        assert growth[name].values[1, 1] == reduce(one.tau, one.log_growth[0], 8.0)
