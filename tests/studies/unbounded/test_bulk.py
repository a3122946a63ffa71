"""The bulk in runs: means over its sites and over time, P from the slope of l2^2, and its law."""

import numpy as np
import pytest
from made_up_unbounded import POWER, TAU, TERMS, spread, thermal
from oracle import random_chain
from pendula.ledger.changes import put
from pendula.ledger.criterion import Verdict
from pendula.studies.unbounded.active_sites import run_long
from pendula.studies.unbounded.bulk import (
    LENGTH,
    NEIGHBOURS,
    bulk_maxima,
    bulk_means,
    bulk_of,
    bulk_powers,
    energy_terms,
    late_means,
    mean_powers,
    mean_terms,
    slope_powers,
    statistics_of,
    thermal_powers,
)
from pendula.studies.unbounded.claims_bulk import (
    at_energy,
    unbounded_equilibrium,
    unbounded_slope,
    unbounded_warm,
    with_power,
)
from pendula.studies.unbounded.long_runs import measure_growth
from problems import constants_of, problem_of

CONSTANTS = constants_of((1.2, 0.7, -3.0))


def exact(delay=1.4, **changes):
    """Return runs whose l2^2 is 2 v P tau less the delay, and an offset of -50."""
    run = spread(0.5, delay=delay, **changes)
    passed = 2.9 * TAU - delay * np.log(np.maximum(TAU, 1.0))
    return run.assign(l2=0.0 * run["l2"] + np.sqrt(np.maximum(2.0 * POWER * passed - 50.0, 1.0)))


def test_means_of_the_bulk_are_those_of_its_sites():
    half = random_chain(12, even=True)[:, 12:]
    state = np.zeros((4, half.shape[1] + 2))
    state[:, 1:-1] = half[0].real, half[0].imag, half[1].real, half[1].imag
    (power, *terms), again = bulk_means(state, CONSTANTS, np.array([10.0, 10.9]))
    assert power == pytest.approx((np.abs(half[:, 1:9]) ** 2).sum(axis=0).mean())
    np.testing.assert_allclose(terms, energy_terms(state, CONSTANTS)[:, 1:9].mean(axis=1))
    assert again[0] == power


def test_a_run_keeps_the_means_of_its_bulk():
    problem = problem_of("fig4_small", half_width=None, end_time=6.0)
    run = run_long(problem, 1e-20)
    found = bulk_means(run.state, problem.constants, run.front[-1])
    np.testing.assert_array_equal(run.bulk[-1], found)
    assert run.bulk.shape == (3, 4, 5)
    np.testing.assert_array_equal(run.maxima[-1], bulk_maxima(run.state, run.front[-1, -1]))


def test_maxima_are_those_of_blocks_on_the_first_half_of_the_way_to_the_front():
    half = random_chain(40, even=True)[:, 40:]
    state = np.zeros((4, half.shape[1] + 2))
    state[:, 1:-1] = half[0].real, half[0].imag, half[1].real, half[1].imag
    sites = np.abs(half).max(axis=0)[1:19]  # the front is at 38.7; its centre is left out
    found = bulk_maxima(state, 38.7)
    for i, size in enumerate(NEIGHBOURS):
        ends = range(size, 19, size)
        maxima = [max(sites[end - size : end]) for end in ends]
        assert found[i] == pytest.approx(np.mean(maxima) if maxima else np.nan, nan_ok=True), size
    assert np.isfinite(found).tolist() == [True] * 5 + [False] * 2
    assert np.isnan(bulk_maxima(state, -1.0)).all()


def test_late_means_are_taken_of_the_late_half():
    run = spread(0.5)
    tau = run["piece_tau"].values
    assert late_means(tau, run)[0] == pytest.approx(tau[tau > 100.0].mean())
    np.testing.assert_allclose(late_means(tau, run, 2), [125.0, 175.0], atol=1.5)
    assert mean_powers(run) == pytest.approx(POWER, rel=0.01)
    assert bulk_powers(run, 4.0).shape == (1, 2, len(tau))
    np.testing.assert_allclose(mean_terms(run, 4.0)[0, 0], TERMS, rtol=1e-3)


def test_the_slope_gives_the_power_whatever_the_offset_and_the_delay():
    assert slope_powers(exact())[0].value == pytest.approx(POWER, rel=1e-9)
    assert slope_powers(exact(delay=0.5))[0].value == pytest.approx(POWER, rel=1e-9)
    assert np.isnan(slope_powers(exact(delay=0.0))[0].value)


def test_the_line_through_the_squares_starts_at_a_quarter_of_the_run():
    run = exact().isel(tau=slice(0, 395, 2))  # times to 197, whose quarter is 49.25
    for first, right in ((49.0, True), (50.0, False)):
        spoilt = run.assign(l2=run["l2"].where(run["tau"] > first, 0.0))
        assert (abs(slope_powers(spoilt)[0].value - POWER) < 1e-6) == right


def test_the_quarter_of_the_run_is_itself_on_the_line():
    for first, right in ((49.5, True), (50.0, False)):
        spoilt = exact().assign(l2=exact()["l2"].where(exact()["tau"] > first, 0.0))
        assert (abs(slope_powers(spoilt)[0].value - POWER) < 1e-6) == right


def test_thermal_powers_are_unknown_where_none_was_solved():
    found = thermal_powers(thermal(), np.array([2.0, 3.0]))
    assert found[0] == POWER and np.isnan(found[1])
    assert thermal_powers(thermal(), np.array(5.0)) == POWER
    assert at_energy(thermal(), 3.0)["power"] == pytest.approx(POWER + 0.1)


def test_the_law_has_no_fitted_constant_and_the_offset_is_found():
    one = measure_growth({"fig4_small": exact()}, thermal()).isel(case=0)
    assert one["law"] == pytest.approx(2.0 * 2.9 * POWER)
    left = one["l2_rate"].sel(band="mean") - one["law_rate"]
    np.testing.assert_allclose(left, one["offset_rate"], rtol=1e-6)
    np.testing.assert_allclose(one["offset_rate"] * one["span_tau"], -50.0, rtol=0.02)


@pytest.mark.parametrize("name", ["epsilon", "gamma"])
def test_a_run_of_other_constants_than_the_thermal_states_has_no_law(name):
    growth = measure_growth({"fig4_small": exact()}, thermal().assign_attrs({name: 2.0}))
    assert all(growth[law].isnull().all() for law in ("law", "law_rate", "thermal_linf"))


def test_verdicts_on_the_bulk_follow_from_its_errors():
    band = exact(variants=3, omegas=(-1.0, 2.0, 5.0), members=4)
    assert unbounded_equilibrium(band, thermal()).verdict == Verdict.CONFIRMED
    off = band.assign(
        bulk_power=band["bulk_power"] * np.array([1.0, 0.9, 1.0])[:, None, None, None]
    )
    finding = unbounded_equilibrium(off, thermal())
    assert finding.verdict == Verdict.CAVEAT and "2 (-10" in finding.because
    centre = exact(members=4)
    assert unbounded_slope(centre, band, thermal()).measured["centre"] == pytest.approx(1.0)
    steeper = centre.assign(l2=1.05 * centre["l2"])
    assert unbounded_slope(steeper, band, thermal()).verdict == Verdict.NOT_REPRODUCED


def test_a_bulk_with_energy_is_held_to_the_state_of_that_energy():
    warm = spread(0.5, omegas=(-4.0,), members=4)
    finding = unbounded_warm(warm, thermal())
    assert finding.verdict == Verdict.CONFIRMED
    assert finding.measured["energy"] == pytest.approx(sum(TERMS), abs=0.05)
    cold = warm.assign(bulk_terms=warm["bulk_terms"] - sum(TERMS) / 4.0)
    assert unbounded_warm(cold, thermal()).verdict == Verdict.NOT_REPRODUCED
    thin = warm.assign(bulk_power=0.9 * warm["bulk_power"])
    assert unbounded_warm(thin, thermal()).verdict == Verdict.NOT_REPRODUCED


def test_a_bulk_is_told_from_the_state_of_no_energy_or_nothing_is_decided():
    warm = spread(0.5, omegas=(-4.0,), members=4)
    cold = put("warm_power", at_energy(thermal(), 0.0)["power"])(thermal())
    assert unbounded_warm(warm, cold).verdict == Verdict.NOT_REPRODUCED
    without = with_power(warm=False)(warm, thermal())
    finding = unbounded_warm(without, thermal())
    assert finding.verdict == Verdict.NOT_REPRODUCED
    assert "agrees with the state of no energy (15.80)" in finding.because
    scatter = warm["member"].copy(data=np.array([0.95, 1.05, 0.95, 1.05]))
    wide = warm.assign(bulk_power=warm["bulk_power"] * scatter)
    assert unbounded_warm(wide, thermal()).verdict == Verdict.UNDECIDED


def test_a_bulk_that_still_moves_to_its_state_decides_nothing():
    warm = spread(0.5, omegas=(-4.0,), members=4)
    tau = warm["piece_tau"]
    late = warm.assign(bulk_power=warm["bulk_power"] - 2.0 * (1.0 - tau / tau[-1]))
    finding = unbounded_warm(late, thermal())
    assert finding.verdict == Verdict.UNDECIDED and "the last quarter" in finding.because
    assert finding.measured["moved_at_most"] == pytest.approx(0.5, abs=0.1)
    settled = warm.assign(bulk_power=warm["bulk_power"] - 0.5)
    assert unbounded_warm(settled, thermal()).verdict == Verdict.NOT_REPRODUCED


def test_the_error_of_the_energy_widens_the_limits_of_p():
    warm = spread(0.5, omegas=(-4.0,), members=4)
    energies = warm["member"].copy(data=np.array([0.5, 1.5, 0.5, 1.5]))
    uneven = warm.assign(bulk_terms=warm["bulk_terms"] * energies)
    wide, narrow = (unbounded_warm(run, thermal()).measured for run in (uneven, warm))
    spans = [one["off_thermal_at_most"] - one["off_thermal_at_least"] for one in (wide, narrow)]
    known = 0.1 * 2.0 * wide["energy_error"]  # P rises by 0.1 per unit of energy
    assert spans[0] == pytest.approx(known, rel=0.2) and spans[0] > 3.0 * spans[1]


def test_the_bulk_is_nine_tenths_of_the_way_to_the_front_without_the_centre():
    assert bulk_of(np.zeros((4, 300)), 200) == slice(1, 180)
    assert bulk_of(np.zeros((4, 300)), 0) == slice(1, 2)


def test_waves_and_moduli_are_given_at_the_middle_of_their_cells():
    found = statistics_of(np.zeros(LENGTH), np.zeros(2), np.array([0.0, 1.0, 3.0]))
    assert found["wave_number"].values[[0, 16, 32]].tolist() == [0.0, np.pi / 2.0, np.pi]
    assert len(found["wave_number"].values) == 64
    assert found["modulus"].values.tolist() == [0.5, 2.0]
