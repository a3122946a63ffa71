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


def test_means_and_errors_of_spans_are_as_they_are_defined():
    drawn = curves(LAWS["power_of_tau"], 5)
    found, edges = span_means(TAU, drawn, START), np.geomspace(START, 400.0, 9)
    places = np.clip(np.searchsorted(edges, TAU, "right") - 1, -1, 7)
    means = np.array([[series[places == span].mean() for span in range(8)] for series in drawn])
    np.testing.assert_allclose(found.values, means.mean(axis=0))
    # one variance for all spans, and a span's share of it is one over its length
    lengths, off = np.diff(edges), means - means.mean(axis=0)
    variance = np.sum(off**2 * lengths) / (8 * 4)
    np.testing.assert_allclose(found.errors, np.sqrt(variance / lengths / 5))
    assert found.freedom == 8 * 4
    scaled = off * np.sqrt(lengths)
    beside = np.mean(scaled[:, 1:] * scaled[:, :-1]) / np.mean(scaled**2)
    assert found.neighbours == pytest.approx(beside)
    for span, times in enumerate(found.times):
        np.testing.assert_array_equal(times, TAU[places == span])


STRAIGHT = {
    "limit_less_1_over_tau": (lambda y: y, lambda y: 1.0, lambda tau: -1.0 / tau),
    "limit_less_1_over_root_tau": (lambda y: y, lambda y: 1.0, lambda tau: -(tau**-0.5)),
    "limit_less_1_over_fourth_root_tau": (lambda y: y, lambda y: 1.0, lambda tau: -(tau**-0.25)),
    "limit_less_1_over_tenth_root_tau": (lambda y: y, lambda y: 1.0, lambda tau: -(tau**-0.1)),
    "log_tau": (lambda y: y, lambda y: 1.0, np.log),
    "fourth_root_of_log_tau": (lambda y: y**4, lambda y: 4.0 * y**3, np.log),
    "power_of_tau": (np.log, lambda y: 1.0 / y, np.log),
}
"""Of each law: how y is bent, the slope of that, and what it is a line in."""


@pytest.mark.parametrize("name", STRAIGHT)
def test_a_law_is_the_weighted_line_that_numpy_lays(name):
    means = span_means(TAU, curves(LAWS["log_tau"]), START)
    bend, steepness, of_time = STRAIGHT[name]
    x = np.array([of_time(times).mean() for times in means.times])
    z, errors = bend(means.values), means.errors * steepness(means.values)
    (slope, height), variances = np.polyfit(x, z, 1, w=1.0 / errors, cov="unscaled")
    bounded, growing = compare(means)
    found = {**bounded, **growing}[name]
    chi2 = np.sum(((z - height - slope * x) / errors) ** 2)
    assert (found.chi2, found.criterion) == pytest.approx((chi2, chi2 + 4.0))
    half = 2.02107 * np.sqrt(variances[0, 0])  # Student's t of 40 degrees of freedom
    assert tuple(found.slope) == pytest.approx((slope, slope - half, slope + half), rel=1e-5)
    assert bend(found.at(900.0)) == pytest.approx(height + slope * of_time(900.0))


def test_a_constant_is_the_weighted_mean():
    means = span_means(TAU, curves(LAWS["constant"]), START)
    found = compare(means)[0]["constant"]
    height = np.average(means.values, weights=1.0 / means.errors**2)
    chi2 = np.sum(((means.values - height) / means.errors) ** 2)
    assert (found.chi2, found.criterion) == pytest.approx((chi2, chi2 + 2.0))
    assert found.at(1e5) == pytest.approx(height) and tuple(found.slope) == (0.0, 0.0, 0.0)


def test_an_output_at_the_edge_of_two_spans_belongs_to_the_later_one():
    tau = np.arange(1.0, 257.0)  # the edges are 1, 2, 4 ... 256
    for span in range(SPANS):
        curve = np.where(tau == 2.0**span, [[1.0], [2.0]], 0.0)
        assert np.flatnonzero(span_means(tau, curve, 1.0).values).tolist() == [span]


def test_a_fourth_root_is_taken_back_from_zero_on():
    law = GROWING["fourth_root_of_log_tau"]
    assert law.unbend(np.array([-1.0, 0.0, 1 / 16, 81.0])).tolist() == [0.0, 0.0, 0.5, 3.0]
