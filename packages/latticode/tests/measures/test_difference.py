"""How far two runs differ, and from when on."""

import numpy as np
import pytest
from latticode.measures.difference import (
    difference,
    divergence_time,
    first_above,
    norm_difference,
)
from two_norms import run


def test_differences_are_parts_of_the_largest_value_of_their_curve():
    changed = run(changes={("l2", 0, 3): 1.0, ("linf", 1, 5): 1.25})
    computed = difference(changed, run())
    assert computed[3] == pytest.approx(1.0 / 2.0)
    assert computed[5] == pytest.approx(0.25 / 1.25)
    assert float(computed.sum()) == pytest.approx(0.7)
    np.testing.assert_array_equal(computed, difference(run(), changed))


def test_a_small_component_that_is_wholly_wrong_is_seen_and_the_scale_of_the_data_is_not():
    large, small = np.full(5, 100.0), np.array([0.0, 1e-6, 2e-6, 0.0, 0.0])
    first, second = np.array([large, small]), np.array([large, small[::-1]])
    assert norm_difference(first, first, first, second)[1] == 0.5
    scaled = norm_difference(1e9 * first, first, 1e9 * first, second)
    np.testing.assert_allclose(scaled, norm_difference(first, first, first, second))


def test_chains_at_rest_do_not_differ():
    at_rest = np.zeros((2, 4))
    assert not norm_difference(at_rest, at_rest, at_rest, at_rest).any()
    assert norm_difference(at_rest, at_rest, at_rest, at_rest + 1e-300).all()


@pytest.mark.parametrize(("off", "samples"), [(5e-10, 11), (2e-9, 1)])
def test_a_longer_reference_is_shortened_and_times_are_the_same_up_to_1e_9(off, samples):
    longer = run(count=21)
    longer["tau"] = 0.5 * np.arange(21) + np.where(np.arange(21) > 0, off, 0.0)
    computed = difference(run(), longer)
    assert computed.sizes["tau"] == samples and not computed.any()


def test_the_first_time_above_a_level_counts_and_never_is_not_unknown():
    computed = difference(run(changes={("l2", 0, 4): 2.03, ("l2", 0, 8): 3.0}), run())
    assert divergence_time(computed, 0.005) == 2.0
    assert divergence_time(computed, 0.2) == 4.0
    assert divergence_time(computed, 0.5) == np.inf
    found_at = {level: divergence_time(computed, level) for level in (0.0099, 0.0101)}
    assert (found_at[0.0099], found_at[0.0101]) == (2.0, 4.0)
    assert np.isnan(divergence_time(computed * np.nan, 0.5))
    values = np.array([[0.0, 1.0, 2.0], [0.0, np.nan, 0.0], [np.nan] * 3])
    np.testing.assert_array_equal(first_above([5, 6, 7], values, 1.0), [7.0, np.inf, np.nan])
    assert first_above([5, 6, 7], [0.0, 1.0, 1.0], 1.0) == np.inf
