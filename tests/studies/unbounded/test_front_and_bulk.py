"""The speed of linear spreading, and the state behind the front."""

import hashlib
from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from made_up_unbounded import PIECES, spread, thermal
from oracle import hamiltonian, random_chain
from pendula.studies.unbounded.active_sites import LEVELS, find_front
from pendula.studies.unbounded.bulk import (
    TERMS,
    complex_pair,
    distribution,
    energy_terms,
    mean_powers,
    profile,
    slope_powers,
    spectrum,
    with_ghosts,
)
from pendula.studies.unbounded.front import (
    group_velocity,
    growth_rate,
    is_unstable,
    linear_front,
    measure_front,
    resolution,
    speeds,
)
from problems import constants_of


def constants(omega):
    return constants_of((1.0, 1.0, omega))


def test_the_speed_at_omega_zero_is_that_of_the_saddle_point():
    front = linear_front(constants(0.0))
    assert front.speed == pytest.approx(2.912, abs=5e-4)
    step = 1e-5
    rate = growth_rate(front.wave_number, front.decay, constants(0.0))
    assert rate == pytest.approx(front.speed * front.decay, rel=1e-9)
    ahead, behind = (
        growth_rate(front.wave_number + h, front.decay, constants(0.0)) for h in (step, -step)
    )
    assert (ahead - behind) / step == pytest.approx(0.0, abs=1e-5)


def test_in_the_middle_of_the_band_the_saddle_is_known():
    """There s = 2 epsilon sin k, so that decay tanh decay = 1 and v = 2 sinh decay."""
    front = linear_front(constants(2.0))
    assert front.decay * np.tanh(front.decay) == pytest.approx(1.0, abs=1e-12)
    assert front.speed == pytest.approx(2.0 * np.sinh(front.decay), rel=1e-12)
    assert front.wave_number == pytest.approx(np.pi / 2, abs=1e-12)


def test_speeds_are_symmetric_about_the_middle_and_scale_with_the_equations():
    assert linear_front(constants(0.5)).speed == pytest.approx(linear_front(constants(3.5)).speed)
    one, twice = linear_front(constants(0.5)), linear_front(constants(0.5).scaled(2.0))
    assert twice.speed == pytest.approx(2.0 * one.speed)


@pytest.mark.parametrize("omega", [-1.95, -1.75, 5.9])
def test_near_the_edge_of_the_band_two_waves_are_equally_fast_at_the_least_speed(omega):
    """No saddle point is the least there, over decays, of the largest speed over waves."""
    front = linear_front(constants(omega))
    waves, nearby = np.linspace(0.0, np.pi, 8001), np.linspace(0.99, 1.01, 41)
    speeds = [
        growth_rate(waves, decay, constants(omega)).max() / decay for decay in nearby * front.decay
    ]
    assert front.speed == pytest.approx(min(speeds), rel=2e-5)


def test_at_the_edge_of_the_band_the_front_becomes_the_fastest_wave():
    inside, outside = linear_front(constants(-1.999)), linear_front(constants(-2.001))
    assert inside.speed == pytest.approx(outside.speed, abs=5e-3)
    assert outside.decay == outside.delay == 0.0 < inside.decay


def test_a_linear_front_bounds_the_linear_chain():
    """Beyond v tau, the solution of the linearised equation is as small as the bound says."""
    sites, tau = 401, 10.0
    front = linear_front(constants(0.0))
    kappa = 2.0 * (1.0 - np.cos(2.0 * np.pi * np.arange(sites) / sites))
    s = np.sqrt(4.0 - kappa**2 + 0j)
    # D = x + i y: x' = -(kappa + 2) y and y' = (kappa - 2) x, from x = y = 1 on one site
    x = np.fft.ifft(np.cosh(s * tau) - (kappa + 2.0) * np.sinh(s * tau) / s).real
    size = np.abs(x[: sites // 2])
    n = np.arange(sites // 2)
    rounding = 1e-14 * size.max()
    bound = np.exp(-front.decay * (n - front.speed * tau))
    assert (size <= 3.0 * bound + rounding).all()
    reached = np.flatnonzero(size > 1.0).max()
    assert abs(reached - (front.speed * tau - front.delay * np.log(tau))) < 2.0


@pytest.mark.parametrize(
    "numbers", [*((1.0, 1.0, omega) for omega in (-1.5, 0.0, 2.0, 5.5)), (0.7, 0.9, 0.4)]
)
def test_the_curvature_at_the_saddle_is_that_of_the_rate(numbers):
    epsilon, gamma, omega = numbers
    front, step = linear_front(constants_of(numbers)), 1e-3
    k = front.wave_number + 1j * front.decay

    def branch(k):
        s = np.sqrt(4.0 * gamma**2 - (2.0 * epsilon * (1.0 - np.cos(k)) - omega) ** 2 + 0j)
        return s if s.real > 0 else -s

    second = (branch(k + step) - 2.0 * branch(k) + branch(k - step)) / step**2
    assert front.diffusion == pytest.approx(-0.5 * second, rel=1e-4)
    lost = 3.0 * np.sqrt(np.pi) * (front.diffusion**-0.5).real / front.decay**2
    assert (front.delay, front.rest) == pytest.approx((1.5 / front.decay, lost))


def front_of(way, tau, rest=0.0):
    """Return a run of the shape that `speeds` reads, with the places `way` of its front."""
    front = (("variant", "member", "piece_tau", "front_power"), way[None, None, :, None])
    predicted = {"predicted_delay": ("variant", [1.4]), "predicted_rest": ("variant", [rest])}
    return xr.Dataset({"front": front} | predicted, {"piece_tau": tau, "front_power": [1e-2]})


def test_the_speed_of_a_made_up_front():
    tau = np.arange(2.0, 202.0, 2.0)
    run = front_of(2.5 * tau - 1.4 * np.log(tau) - 3.0 / np.sqrt(tau), tau, rest=3.0)
    plain, error = speeds(run)
    corrected, _ = speeds(run, corrected=True)
    assert plain[0] < 2.495 and corrected[0] == pytest.approx(2.5, abs=1e-9)
    assert error[0] == resolution(tau) == pytest.approx(1.5 / 133.3, rel=1e-3)


def test_no_half_site_to_and_fro_moves_a_speed_by_more_than_the_resolution():
    """The worst case is a front half a site behind at first, and half a site ahead later."""
    tau = np.arange(2.0, 202.0, 2.0)
    middle = 0.5 * (tau[-1] + tau[-1] / 3.0)
    worst = front_of(2.5 * tau + 0.5 * np.sign(tau - middle), tau)
    off = abs(speeds(worst)[0][0] - 2.5)
    assert 0.95 * resolution(tau) < off < 1.02 * resolution(tau)
    rng = np.random.default_rng(3)
    for _ in range(50):
        noisy = front_of(2.5 * tau + rng.uniform(-0.5, 0.5, tau.size), tau)
        assert abs(speeds(noisy)[0][0] - 2.5) < resolution(tau)


def test_a_front_is_found_between_two_sites():
    power = 4.0 * np.exp(-2.0 * np.arange(12.0))
    state = np.zeros((4, 14))
    state[0, 1:-1] = np.sqrt(power)
    found = find_front(state)
    exact = [round(np.log(4.0 / level) / 2.0, 3) for level in (1e-6, 1e-2, 1.0)]
    np.testing.assert_allclose(found, [*exact, -1.0], atol=1e-9)  # a thousandth of a site is kept


def test_terms_of_the_energy_add_up_to_it():
    z = random_chain(9, even=True)
    state = np.zeros((4, 12))
    half = z[:, 9:]
    state[:, 1:-1] = half[0].real, half[0].imag, half[1].real, half[1].imag
    terms = energy_terms(state, constants_of((1.2, 0.7, -3.0)))
    bonds = terms[3]
    both = 2.0 * terms.sum() - terms[:3, 0].sum()  # the centre has no twin, each bond has one
    assert both == pytest.approx(hamiltonian(z, (1.2, 0.7, -3.0), "dirichlet"), rel=1e-12)
    assert (bonds <= 0).all()


def test_profile_spectrum_and_distribution():
    np.testing.assert_allclose(profile(np.arange(10.0)[None], np.array([0, 2, 10])), [[0.5, 5.5]])
    wave = 3.0 * np.exp(2j * np.pi * 5 / 16 * np.arange(40))
    expected = np.zeros(16)
    expected[5] = 9.0 * 16
    np.testing.assert_allclose(spectrum(wave, 16), expected, atol=1e-10)
    assert spectrum(wave, 16).mean() == pytest.approx(9.0)
    moduli = np.random.default_rng(0).random(50)
    assert distribution(moduli, np.linspace(0, 2, 9)).sum() * 0.25 == pytest.approx(1.0)
    assert complex_pair(with_ghosts(np.ones((4, 3))))[1].tolist() == [1 + 1j] * 3


def test_the_first_third_of_a_run_is_left_out_of_its_speed():
    """Of a run to 300 the part from 100 on counts, with 100 itself."""
    tau = np.arange(1.0, 301.0)
    late = front_of(np.where(tau < 100.0, 0.0, 2.5 * tau), tau)
    assert speeds(late)[0][0] == pytest.approx(2.5, abs=1e-12)
    later = front_of(np.where(tau < 101.0, 0.0, 2.5 * tau), tau)
    assert abs(speeds(later)[0][0] - 2.5) > 0.01


def test_the_limits_of_a_speed_are_those_of_its_mean_over_members():
    """Student's t of two members, 12.706, times half of their difference."""
    tau = np.arange(2.0, 202.0, 2.0)
    one = front_of(2.0 * tau, tau)
    both = xr.concat([one, front_of(3.0 * tau, tau)], "member", data_vars=["front"])
    speed, limits = speeds(both)
    assert (speed[0], limits[0]) == pytest.approx((2.5, 12.7062 * 0.5), rel=1e-5)


@pytest.mark.parametrize(("epsilon", "gamma"), [(1.0, 1.0), (0.5, 0.3), (2.0, 0.7)])
def test_rest_is_unstable_from_two_gamma_below_the_band_to_two_gamma_above_it(epsilon, gamma):
    low, high = -2.0 * gamma, 4.0 * epsilon + 2.0 * gamma
    for omega, unstable in ((low, 0), (low + 1e-9, 1), (high - 1e-9, 1), (high + 1e-9, 0)):
        assert is_unstable(constants_of((epsilon, gamma, omega))) == bool(unstable)


def of_wave(k, numbers):
    """Return s of a wave of D = A - B: x' = -(kappa + 2 gamma) y and y' = (kappa - 2 gamma) x."""
    epsilon, gamma, omega = numbers
    kappa = 2.0 * epsilon - 2.0 * epsilon * np.cos(k) - omega
    matrix = np.array([[0.0, -kappa - 2.0 * gamma], [kappa - 2.0 * gamma, 0.0]])
    return max(np.linalg.eigvals(matrix), key=lambda s: (s.real, s.imag))


@pytest.mark.parametrize("numbers", [(0.8, 0.3, -1.5), (1.3, 0.6, 9.0), (0.7, 0.9, 0.4)])
def test_waves_grow_and_move_as_the_matrix_of_each_says(numbers):
    constants, step = constants_of(numbers), 1e-5
    for k in (0.4, 1.3, 2.9):
        assert growth_rate(k, 0.0, constants) == pytest.approx(of_wave(k, numbers).real, abs=1e-12)
        ahead, behind = of_wave(k + step, numbers), of_wave(k - step, numbers)
        if ahead.imag:
            speed = abs(ahead.imag - behind.imag) / (2.0 * step)
            assert group_velocity(k, constants) == pytest.approx(speed, rel=1e-6)


def test_without_a_front_that_is_pulled_the_fastest_wave_leads():
    numbers = (0.8, 0.3, -1.5)
    k = np.linspace(0.0, np.pi, 4001)
    frequencies = np.array([of_wave(one, numbers).imag for one in k])
    front = linear_front(constants_of(numbers))
    assert front.speed == pytest.approx((np.abs(np.diff(frequencies)) / k[1]).max(), rel=1e-5)
    assert front.delay == front.rest == front.diffusion == 0.0
    growth = of_wave(front.wave_number, numbers)
    near = [of_wave(front.wave_number + step, numbers) for step in (-2e-3, 2e-3)]
    assert growth.imag - near[0].imag == pytest.approx(near[1].imag - growth.imag, rel=1e-3)


def test_a_front_next_to_nothing_stands_on_its_last_site():
    state = np.zeros((2, 12))
    state[0, 3:6] = 3.0  # sites 2 to 4, and nothing before or behind them
    assert find_front(state).tolist() == [4.0] * len(LEVELS)
    state[0, 4:7] = 0.0, 3.0, 1e-4  # now nothing before it, and little behind it
    assert 4.0 < find_front(state)[0] < 5.0
    state[0, 1:-1] = 3.0
    assert find_front(state).tolist() == [9.0] * len(LEVELS)


def along(dimension, values):
    """Return values along a dimension, to be added to what a made-up run holds."""
    return xr.DataArray(values, dims=dimension)


def told_apart(run):
    """Return a run whose fronts differ by their power, by a pace a variant, and by the member."""
    members, pace = np.arange(run.sizes["member"]), 0.3 * np.arange(run.sizes["variant"])
    front = run["front"] + along("front_power", [7.0, 0.0, -7.0, -14.0])
    front = front + 3.0 * along("member", members)
    front = front + along("variant", pace) * along("piece_tau", PIECES)
    return run.assign(front=front, predicted_rest=0.0 * run["predicted_rest"] + 0.7)


@pytest.fixture(scope="module")
def measured():
    """The fronts of made-up runs that all differ, and the runs and thermal states behind them."""
    bulk = told_apart(spread(0.5, members=3, omegas=(2.0,)))
    omegas = told_apart(spread(0.5, variants=3, omegas=(-1.0, 2.0, 5.0)))
    omegas["bulk_power"] = omegas["bulk_power"] * along("variant", [1.0, 1.1, 1.2])
    states, large = thermal(), told_apart(spread(0.5, omegas=(-4.0,)))
    for name in ("power", "density", "spectrum"):
        states[name] = states[name].copy(data=states[name] * (1.0 + along("omega", np.arange(4))))
    return measure_front(omegas, bulk, large, states), omegas, bulk, states


def test_each_omega_has_the_speed_and_the_power_of_its_members(measured):
    found, omegas, _, states = measured
    assert found["omega"].values.tolist() == [-1.0, 2.0, 5.0]
    for name, corrected in (("speed", False), ("corrected_speed", True)):
        values, limits = speeds(omegas, corrected=corrected)
        np.testing.assert_array_equal(found[name], values)
        np.testing.assert_array_equal(found[f"{name}_error"], limits)
    np.testing.assert_allclose(found["corrected_speed"], [2.9, 3.2, 3.5], atol=3e-3)
    np.testing.assert_array_equal(found["predicted_speed"], 2.9)
    powers = mean_powers(omegas)
    np.testing.assert_allclose(found["mean_power"], powers.mean(axis=1), rtol=1e-12)
    half = 12.7062 * np.abs(np.diff(powers)[:, 0]) / 2.0  # Student's t of two members
    np.testing.assert_allclose(found["mean_power_error"], half, rtol=1e-5)
    np.testing.assert_array_equal(found["expected_power"], states["power"][[0, 2, 3]])
    slopes = [(one.value, one.half) for one in slope_powers(omegas)]
    told = np.transpose([found["slope_power"], found["slope_power_error"]])
    np.testing.assert_array_equal(told, slopes)


def test_the_line_of_speeds_is_that_of_the_saddle_points(measured):
    found, *_ = measured
    np.testing.assert_array_equal(found["line_omega"], -4.0 + 0.125 * np.arange(97))
    at = found["line_speed"].assign_coords(line_omega=found["line_omega"])
    assert at.sel(line_omega=2.0) == linear_front(constants(2.0)).speed
    assert at.sel(line_omega=-3.0) == linear_front(constants(-3.0)).speed


def test_the_ways_shown_are_those_of_first_members_at_their_powers(measured):
    found, *_ = measured
    np.testing.assert_array_equal(found["piece_tau"], PIECES)
    np.testing.assert_array_equal(found["large_tau"], PIECES)
    way = np.floor(2.9 * PIECES - 1.4 * np.log(PIECES))
    steps = 0.3 * np.arange(3)[:, None] * PIECES
    np.testing.assert_allclose(found["front"], way + steps, rtol=1e-12)
    np.testing.assert_allclose(found["large_front"], way - 14.0, rtol=1e-12)
    assert (found.attrs["omega"], found.attrs["large_omega"]) == (2.0, -4.0)


def test_the_way_of_a_front_is_told_behind_its_speed_in_spans_of_log_time(measured):
    found, _, bulk, _ = measured
    edges = [*np.geomspace(2.0, 200.0, 36), np.inf]
    spans = [(PIECES - low >= 0.0) & (PIECES - high < 0.0) for low, high in pairwise(edges)]
    spans = [span for span in spans if span.any()]
    np.testing.assert_allclose(found["way_tau"], [PIECES[span].mean() for span in spans])
    behind = bulk["front"].values[0, :, :, 1].mean(axis=0) - 2.9 * PIECES
    np.testing.assert_allclose(found["behind"], [behind[span].mean() for span in spans], atol=1e-9)
    assert (found["delay"], found["front_rest"]) == (1.4, 0.7)


def test_the_state_behind_a_front_is_the_mean_over_members_of_the_sites_behind_each(measured):
    found, _, bulk, _ = measured
    states = [with_ghosts(state) for state in bulk["state"].values[0]]
    fronts = bulk["front"].values[0, :, -1, 1].astype(int)
    assert len(set(fronts)) == 3
    np.testing.assert_allclose(found["scaled_site"], (np.arange(24) + 0.5) * 0.05)
    far = ((0, 0), (0, 1000))  # beyond its last site a chain is at rest
    terms = [np.pad(energy_terms(state, constants(2.0)), far) for state in states]
    for cell, (low, high) in enumerate(pairwise(np.linspace(0.0, 1.2, 25))):
        inside = [
            one[:, int(low * front) : int(high * front)].mean(axis=1)
            for one, front in zip(terms, fronts, strict=True)
        ]
        np.testing.assert_allclose(found["mean_terms"][:, cell], np.mean(inside, axis=0), atol=1e-9)
    assert list(found["term"].values) == list(TERMS)
    waves = [z[1 : int(0.9 * 580)] for state in states for z in complex_pair(state)]
    spectra = np.mean([spectrum(z, 64) for z in waves], axis=0)
    np.testing.assert_allclose(found["spectrum"], spectra, rtol=1e-12)
    moduli = np.abs(np.concatenate(waves))
    cells = np.linspace(0.0, 1.05 * moduli.max(), 41)
    np.testing.assert_allclose(found["modulus"], 0.5 * (cells[1:] + cells[:-1]), rtol=1e-12)
    counts = np.histogram(moduli, cells, density=True)[0]
    np.testing.assert_allclose(found["density"], counts, rtol=1e-12)


def test_the_bulk_is_compared_with_the_thermal_state_of_its_omega(measured):
    found, _, _, states = measured
    np.testing.assert_array_equal(found["thermal_omega"], states["omega"])
    np.testing.assert_array_equal(found["thermal_power"], states["power"])
    for name in ("modulus", "density", "spectrum"):
        np.testing.assert_array_equal(found[f"thermal_{name}"], states.sel(omega=2.0)[name])


def test_no_thermal_state_of_another_omega_stands_beside_the_bulk(measured):
    _, omegas, bulk, states = measured
    found = measure_front(omegas, bulk.assign_attrs(omega=8.0), bulk, states)
    assert np.isnan(found["thermal_density"]).all() and np.isnan(found["thermal_spectrum"]).all()


HASH = "ba346a3eb4b76d4a"
"""Of the bits that every machine must get of the fronts below."""


def test_the_bits_of_predicted_fronts_are_those_of_every_machine():
    fronts = [linear_front(constants(omega)) for omega in (-3.0, -1.5, 0.0, 2.0, 5.5)]
    told = [(*front[:3], front.diffusion.real, front.diffusion.imag) for front in fronts]
    assert hashlib.sha256(np.array(told).tobytes()).hexdigest()[:16] == HASH
