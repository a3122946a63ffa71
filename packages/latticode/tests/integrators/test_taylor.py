"""taylor: how a series lies in memory, its sums, its sizes, and the step that they allow."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from latticode.integrators import taylor
from latticode.integrators.taylor import BLOCK_SIZE, ORDER, WORK, lay_out, write_state
from latticode.kernels.simd import LANES


def describe(y, work):
    """Return the series of states like `y`, laid out by Python: no kernel returns a view."""
    return lay_out.py_func(work, y)


@given(st.floats(1e-300, 1e300))
@example(0.0)
@example(np.inf)
def test_the_roots_have_four_digits(x):
    assert taylor.sixteenth_root(x) == pytest.approx(x ** (1 / 16), rel=1e-14)
    assert taylor.fifteenth_root(x) == pytest.approx(x ** (1 / 15), rel=1e-4)


@pytest.mark.parametrize("largest", [0.0, 1e-300, 1e-150, 2.0, np.inf, np.nan])
@pytest.mark.parametrize("place", [0, 5, 11])
def test_the_largest_modulus_counts_nan_as_larger_than_infinity(largest, place):
    y = np.zeros((2, 14))
    y[:, 1:-1] = 0.3 * largest
    y[1, 1 + place] = -largest
    y[0, 1 + place] = 0.0
    y[:, 1 + (place + 1) % 12] = 0.1 if np.isnan(largest) else 0.0
    series = describe(y, np.zeros((WORK, *y.shape)))
    write_state(y, series)
    assert taylor.largest_modulus(series, 0) == pytest.approx(
        largest, rel=1e-15, abs=0.0, nan_ok=True
    )


@pytest.mark.parametrize(
    ("last_but_one", "last"), [(1.0, 1e-3), (1e-3, 1.0), (np.inf, 1.0), (1.0, np.inf)]
)
def test_a_step_is_allowed_by_the_last_two_orders(last_but_one, last):
    """The tolerance is 0.35: 0.2, and 0.3 of the modulus 0.5."""
    series = describe(np.zeros((2, 3)), np.zeros((WORK, 2, 3)))
    c = series.memory[:BLOCK_SIZE].reshape(ORDER + 1, 3, LANES)
    c[0, :2, 0], c[ORDER - 1, 0, 0], c[ORDER, 1, 0] = (0.3, 0.4), last_but_one, -last
    step = taylor.allowed_step(series, 0.3, 0.2)
    expected = min((0.35 / last) ** (1 / ORDER), (0.35 / last_but_one) ** (1 / (ORDER - 1)))
    expected = expected if last + last_but_one < np.inf else np.nan
    assert step == pytest.approx(expected, rel=1e-3, nan_ok=True)
