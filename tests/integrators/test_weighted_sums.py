"""Weighted sums of slopes, against the formula that is written out."""

import numpy as np
import pytest
from pendula.integrators.weighted_sums import STRIP, table, write_sum
from pendula.simd import LANES

ROWS = table({0: {2: 0.3}, 2: {1: -0.7, 3: 1.1, 4: 1e-3}}, 3)
SIZES = [1, LANES - 1, LANES, LANES + 1, STRIP - 1, STRIP, STRIP + 1, 2 * STRIP + LANES + 3]


@pytest.fixture(params=SIZES)
def numbers(request):
    rng = np.random.default_rng(request.param)
    return rng.normal(size=request.param), rng.normal(size=(5, request.param))


def test_a_sum_has_the_bits_of_its_terms_in_their_order(numbers):
    y, k = numbers
    out = np.full(len(y) + 1, np.nan)
    write_sum(ROWS, 2, y, 0.9, k, out[:-1])
    np.testing.assert_array_equal(out[:-1], y + 0.9 * ((-0.7 * k[0] + 1.1 * k[2]) + 1e-3 * k[3]))
    assert np.isnan(out[-1])


def test_nothing_is_added_where_there_is_no_start(numbers):
    y, k = numbers
    out = np.empty_like(y)
    write_sum(ROWS, 0, y[:0], 0.9, k, out)
    np.testing.assert_array_equal(out, 0.9 * (0.3 * k[1]))
