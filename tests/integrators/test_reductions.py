"""The largest of many numbers, whatever they are."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pendula.integrators.reductions import largest, largest_of_rows


@given(st.lists(st.floats(allow_nan=False), min_size=1, max_size=40))
def test_the_largest_absolute_value(numbers):
    assert largest(np.array(numbers)) == max(map(abs, numbers))


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("place", [0, 3, 17, 32])
def test_a_nan_of_either_sign_is_found_beside_infinity(sign, place):
    """Zero by zero makes a NaN with the sign bit set on some processors."""
    numbers = np.ones(33)
    numbers[5] = np.inf
    numbers[place] = np.copysign(np.nan, sign)
    assert np.isnan(largest(numbers))


def test_ghosts_and_later_rows_do_not_count():
    scratch = np.full((4, 5), 9.0)
    scratch[:2, 1:-1] = [[1, 2, 3], [3, 2, 4]]
    assert largest_of_rows(scratch, 2) == 4
