"""Confidence limits: against SciPy's own, and how often they enclose what is known."""

from itertools import permutations

import numpy as np
import pytest
from latticode.measures import confidence

RNG = np.random.default_rng(3)


@pytest.fixture(scope="module")
def stats():
    """Return SciPy's own statistics, which take a third of a second to import."""
    from scipy import stats

    return stats


def test_limits_of_a_mean_are_student_s(stats):
    values = RNG.normal(3.0, 2.0, size=(8, 3))
    mean, low, high = confidence.mean_limits(values)
    known = stats.ttest_1samp(values, 0.0).confidence_interval(0.95)
    np.testing.assert_allclose([low, high], [known.low, known.high], rtol=1e-5)
    np.testing.assert_allclose(mean, values.mean(axis=0))
    assert confidence.mean_limits([4.0]) == (4.0, -np.inf, np.inf)
    assert confidence.ConfidenceInterval(3.0, 1.0, 6.0).half == 2.5


def test_limits_of_a_difference_are_welch_s(stats):
    first, second = RNG.normal(1.0, 1.0, 6), RNG.normal(0.0, 5.0, 20)
    known = stats.ttest_ind(first, second, equal_var=False).confidence_interval(0.95)
    computed = confidence.difference_limits(first, second)
    np.testing.assert_allclose(computed[1:], [known.low, known.high], rtol=1e-4)
    assert confidence.difference_limits([2.0, 2.0], [1.0, 1.0]) == (1.0, 1.0, 1.0)


@pytest.mark.parametrize(("count", "members"), [(0, 10), (3, 10), (10, 10)])
def test_limits_of_a_share_are_exact(stats, count, members):
    known = stats.binomtest(count, members).proportion_ci(0.95, "exact")
    computed = confidence.share_limits(count, members)
    assert computed.value == count / members
    np.testing.assert_allclose(computed[1:], [known.low, known.high], rtol=1e-5)
    known = stats.binomtest(count, members).proportion_ci(0.8, "exact")
    assert confidence.share_limits(count, members, 0.8)[1:] == pytest.approx(tuple(known), rel=1e-5)


def test_limits_of_a_rate_are_those_of_chi_squared(stats):
    """Two of four lives end, after 1 and 2; with two of 3 and more that makes 9 lived in all."""
    computed = confidence.event_rate([1.0, np.inf, 2.0, np.inf], 0.0, 3.0)
    low, high = stats.chi2.ppf(0.025, 4) / 18.0, stats.chi2.ppf(0.975, 6) / 18.0
    assert tuple(computed) == pytest.approx((2.0 / 9.0, low, high), rel=1e-5)
    none = confidence.event_rate([np.inf] * 64, 10.0, 50.0)
    assert tuple(none) == pytest.approx((0.0, 0.0, -np.log(0.025) / 2560.0), rel=1e-5)
    assert np.isnan(confidence.event_rate([3.0, 4.0], 10.0, 50.0)).all()


@pytest.mark.parametrize(
    ("count", "limits"), [(15, (7.0, 3.0, 11.0)), (10, (4.5, 1.0, 8.0)), (6, (2.5, 0.0, 5.0))]
)
def test_limits_of_a_median_are_the_order_statistics_of_the_sign_test(count, limits):
    """Among 15 the fourth and the twelfth, as tables of the sign test have it."""
    assert confidence.median_limits(np.arange(count)[::-1]) == limits


@pytest.mark.parametrize(
    ("lives", "limits"),
    [
        ([0.0, 1.0, 2.0, 3.0, 4.0], (2.0, -np.inf, np.inf)),  # too few for limits
        ([1.0] * 10 + [np.inf] * 12, (np.inf, 1.0, np.inf)),
        ([1.0, 1.0, np.inf, np.inf], (np.inf, -np.inf, np.inf)),
    ],
)
def test_a_median_that_was_not_lived_to_see_is_infinite(lives, limits):
    assert confidence.median_limits(lives) == limits


def test_the_limits_of_a_ratio_are_just_what_student_s_t_allows():
    """At either limit r the mean of above - r below is t = 2.365 of its standard errors off."""
    means, errors = (10.0, 20.0), (1.0, 2.0)
    computed = confidence.ratio_limits(means, errors, 8)
    for ratio in computed[1:]:
        error = np.hypot(errors[1], ratio * errors[0])
        assert abs(means[1] - ratio * means[0]) / error == pytest.approx(2.36462, rel=1e-5)
    assert computed.value == 2.0 and computed.low < 2.0 < computed.high
    assert np.isinf(confidence.ratio_limits((2.36462, 1.0), (1.0, 1.0), 8).high)
    assert confidence.ratio_limits((2.0, 3.0), (0.0, 0.0), 6) == (1.5, 1.5, 1.5)
    small = confidence.ratio_limits((0.1, 0.2), (0.01, 0.02), 8)  # of another unit
    assert tuple(small) == pytest.approx(tuple(computed))


def test_limits_of_an_order_have_the_width_of_all_orders():
    """All orders of 3 + 2 + 2 values are known, and the share of pairs in each of them."""
    orders = set(permutations((0, 0, 0, 1, 1, 2, 2)))
    groups = [[np.flatnonzero(np.array(order) == first) for first in range(3)] for order in orders]
    shares = np.array([confidence.order_limits(first)[0] for first in groups])
    assert shares.min() == 0.0 and shares.max() == 1.0
    half = confidence.order_limits(groups[0], 0.95).half
    assert half == pytest.approx(1.959964 * shares.std(), rel=1e-5)


def test_limits_of_an_order_enclose_a_half_if_the_group_does_not_matter():
    drawn = RNG.random((2000, 4, 8))
    computed = np.array([confidence.order_limits(groups) for groups in drawn])
    assert np.mean((computed[:, 1] <= 0.5) & (computed[:, 2] >= 0.5)) == pytest.approx(
        0.95, abs=0.02
    )


def test_an_order_of_infinite_and_of_equal_values():
    never, late, soon = [np.inf, np.inf], [5.0, np.inf], [1.0, 2.0]
    assert confidence.order_limits([never, late, soon]).value == pytest.approx(11 / 12)
    assert confidence.order_limits([soon, soon]).value == pytest.approx(0.5)


@pytest.mark.parametrize(("most", "draws", "members"), [(0, 2, 2), (1, 3, 4), (2, 4, 3), (4, 4, 5)])
def test_the_chance_of_draws_within_a_range_is_that_of_all_orders(most, draws, members):
    orders = set(permutations((0,) * draws + (1,) * members))
    inside = []
    for order in orders:
        range_of = np.flatnonzero(order)
        places = np.flatnonzero(np.array(order) == 0)
        inside.append(((places > range_of[0]) & (places < range_of[-1])).sum())
    expected = np.mean(np.array(inside) <= most)
    assert confidence.chance_inside(most, draws, members) == pytest.approx(expected, rel=1e-2)


def test_the_chance_below_a_score_is_student_s(stats):
    assert confidence.chance_below(-7.0, 20) == pytest.approx(stats.t.cdf(-7.0, 20), rel=1e-2)


def test_the_chance_of_counts_is_binomial(stats):
    expected = stats.binom.sf(52, 128, 0.22)
    assert confidence.chance_of_counts(53, 128, 0.22) == pytest.approx(expected, rel=1e-2)
