"""Bounded laws and growing ones are told apart, with errors that know the curves' memory."""

import numpy as np
import pytest
from pendula.measures.laws import BOUNDED, GROWING, SPANS, best, compare, span_means

TAU = np.linspace(0.0, 400.0, 1601)
START, NOISE = 10.0, 0.1


def curves(law, members=6, memory=6, seed=3):
    """Return a law with noise (member, tau) that remembers itself for `memory` outputs."""
    rng = np.random.default_rng(seed)
    white = rng.normal(size=(members, TAU.size + memory - 1))
    window = np.ones(memory) / np.sqrt(memory)
    noise = np.array([np.convolve(series, window, "valid") for series in white])
    return law(np.maximum(TAU, 1.0)) + NOISE * noise


LAWS = {
    "constant": lambda tau: 5.0 + 0.0 * tau,
    "limit_less_1_over_root_tau": lambda tau: 6.0 - 8.0 / np.sqrt(tau),
    "limit_less_1_over_tau": lambda tau: 6.0 - 20.0 / tau,
    "log_tau": lambda tau: 2.0 + 1.0 * np.log(tau),
    "fourth_root_of_log_tau": lambda tau: np.maximum(-300.0 + 400.0 * np.log(tau), 1.0) ** 0.25,
    "power_of_tau": lambda tau: 2.0 * tau**0.3,
}


@pytest.mark.parametrize("name", LAWS)
def test_each_law_is_told_from_the_others(name):
    bounded, growing = compare(span_means(TAU, curves(LAWS[name]), START))
    assert best({**bounded, **growing}) == name
    assert set(bounded) == set(BOUNDED) and set(growing) == set(GROWING)


def test_the_right_law_lies_within_its_errors_and_says_what_comes():
    means = span_means(TAU, curves(LAWS["log_tau"]), START)
    fitted = compare(means)[1]["log_tau"]
    assert fitted.chi2 < 2.0 * SPANS
    assert fitted.slope.low < 1.0 < fitted.slope.high
    assert fitted.at(1e6) == pytest.approx(2.0 + np.log(1e6), abs=0.2)


def test_a_falling_curve_does_not_make_a_growing_law():
    bounded, growing = compare(span_means(TAU, curves(lambda tau: 3.0 + 9.0 / tau), START))
    assert all(fitted.slope.value == 0.0 for fitted in growing.values())
    assert min(f.criterion for f in bounded.values()) < min(f.criterion for f in growing.values())


def test_errors_are_those_of_the_means_however_long_the_curves_remember():
    """Errors that took all outputs as independent would be several times too small."""
    wide, flat = 30, LAWS["constant"]
    drawn = [span_means(TAU, curves(flat, 4, wide, seed), START) for seed in range(60)]
    scatter = np.std([means.values for means in drawn], axis=0)
    error = np.mean([means.errors for means in drawn], axis=0)
    np.testing.assert_allclose(scatter[2:], error[2:], rtol=0.35)
    naive = NOISE / np.sqrt([4 * len(times) for times in drawn[0].times])
    assert (error[2:] > 3.0 * naive[2:]).all()
    assert abs(np.mean([means.neighbours for means in drawn])) < 0.25


def test_one_member_shows_no_scatter():
    assert np.isnan(span_means(TAU, curves(LAWS["constant"], 1), START).errors).all()


def test_each_output_belongs_to_one_span_the_last_one_included():
    for place, span in ((-1, SPANS - 1), (-2, SPANS - 1), (int(START * 4), 0)):
        curve = np.zeros((2, TAU.size))
        curve[:, place] = 1.0, 2.0
        assert np.flatnonzero(span_means(TAU, curve, START).values).tolist() == [span]
