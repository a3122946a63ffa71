"""Variables of checks: rounding to the digits that a library leaves alone."""

import numpy as np
import pytest
from pendula.datasets.checks import rounded, variable


@pytest.mark.parametrize(
    ("value", "expected"),
    [(123456.0, 123000.0), (-0.00123456, -0.00123), (0.0, 0.0), (np.inf, np.inf), (9.999, 10.0)],
)
def test_rounding_keeps_significant_digits(value, expected):
    assert rounded(value, 3) == expected


def test_rounded_values_keep_their_shape_and_say_their_digits():
    values = np.array([[1.23456, 2.0], [np.nan, 1e-300 / 3.0]])
    found = variable(values, ("x", "y"), "values", digits=3)
    assert found["attrs"]["significant_digits"] == 3
    np.testing.assert_array_equal(found["data"], [[1.23, 2.0], [np.nan, 3.33e-301]])


def test_what_is_not_rounded_says_nothing_of_digits():
    found = variable([1.23456], ("x",), "values")
    assert "significant_digits" not in found["attrs"] and found["data"][0] == 1.23456
