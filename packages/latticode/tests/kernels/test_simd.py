"""Each operation of `latticode.kernels.simd`, against NumPy: on the day of a numba upgrade, the
tests that fail name what broke. An error at the import of `simd` names a part of numba that has
gone; the list of those parts, and where to look, is on top of the module.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from latticode.kernels.compiled import uncached
from latticode.kernels.simd import (
    LANES,
    fill,
    fill_from,
    keep_lanes,
    larger_magnitude,
    largest_in_rows,
    largest_lane,
    largest_magnitude,
    left_neighbours,
    load,
    right_neighbours,
    store,
    vector_views,
    zero_below,
)

FIRST = np.array([1.0, -2.0, 3.5, 0.1, 7.7, 1e-3, -0.6, 2.2])
SECOND = np.array([0.3, 5.0, -7.0, 0.2, 1.9, -4.4, 8.8, 0.7])
BOTH = np.concatenate([FIRST, SECOND])
LARGE = [0.0, -0.0, 1e-320, -1.0, 1e300, -np.inf, np.nan, -np.nan]
numbers = st.lists(st.floats(allow_nan=False), min_size=LANES, max_size=LANES).map(np.array)


def rows_of(function, rows, *arguments):
    """Return the vectors that a compiled `function(out, ...)` stores one after another."""
    out = np.full(rows * LANES, np.nan)
    function(out, *arguments)
    return out.reshape(rows, LANES)


# --- Registers and arrays ---


@uncached
def copy_vector(out, array, place):
    store(out, 0, load(array, place))


@uncached
def store_repeated(out, place, number):
    store(out, place, fill(number))


@pytest.mark.parametrize("place", range(LANES + 1))
def test_load_and_store_take_a_vector_from_and_to_any_place_and_fill_repeats_one(place):
    expected = BOTH[place : place + LANES]
    np.testing.assert_array_equal(rows_of(copy_vector, 1, BOTH, place)[0], expected)
    out, expected = np.zeros(2 * LANES), np.zeros(2 * LANES)
    store_repeated(out, place, 0.1)
    expected[place : place + LANES] = 0.1
    np.testing.assert_array_equal(out, expected)


@uncached
def fill_with_vector(out, a, level, place):
    store(out, 0, fill(load(a, place)))
    store(out, LANES, zero_below(load(level, 0), load(a, place)))
    store(out, 2 * LANES, zero_below(level[0], load(a, place)))


@pytest.mark.parametrize("place", range(LANES + 1))
def test_fill_returns_a_vector_as_it_is_and_each_lane_may_have_a_level_for_zero(place):
    vector, level = BOTH[place : place + LANES], np.abs(BOTH[LANES : 2 * LANES])
    filled, by_lane, by_first = rows_of(fill_with_vector, 3, BOTH, level, place)
    np.testing.assert_array_equal(filled, vector)
    np.testing.assert_array_equal(by_lane, np.where(np.abs(vector) < level, 0.0, vector))
    np.testing.assert_array_equal(by_first, np.where(np.abs(vector) < level[0], 0.0, vector))


# --- Arithmetic ---


@uncached
def operate(out, number, a, b):
    first, second = load(a, 0), load(b, 0)
    results = (
        first + second,
        first - second,
        first * second,
        number + first,
        number - first,
        number * first,
        -first,
    )
    for i in range(7):
        store(out, i * LANES, results[i])


@given(x=numbers, y=numbers)
def test_operators_of_vectors_and_of_a_number_to_the_left_have_the_bits_of_numpy(x, y):
    with np.errstate(all="ignore"):
        results = x + y, x - y, x * y, 0.7 + x, 0.7 - x, 0.7 * x, -x
        computed, expected = rows_of(operate, 7, 0.7, x, y), np.array(results)
    np.testing.assert_array_equal(computed, expected)
    np.testing.assert_array_equal(np.signbit(computed[6]), np.signbit(expected[6]))  # of zero too


def test_eight_numbers_are_one_register_to_llvm():
    """No fewer: the code would be right, and slow."""
    rows_of(operate, 7, 0.7, FIRST, SECOND)
    (code,) = operate.inspect_llvm().values()
    assert "fadd <8 x double>" in code


@uncached
def multiply_and_add(out, a, b, c):
    store(out, 0, load(a, 0) * load(b, 0) + load(c, 0))


def test_a_product_and_a_sum_are_never_fused():
    """(1 + e)(1 - e) - 1 is zero when the product is rounded, -e^2 when it is not."""
    e = np.full(LANES, 2.0**-30)
    out = rows_of(multiply_and_add, 1, 1.0 + e, 1.0 - e, -np.ones(LANES))
    np.testing.assert_array_equal(out, 0.0)


# --- Lanes ---


@uncached
def shift_both_ways(out, array):
    store(out, 0, left_neighbours(load(array, 0), load(array, LANES)))
    store(out, LANES, right_neighbours(load(array, 0), load(array, LANES)))


def test_shifts_show_each_site_its_neighbour():
    left, right = rows_of(shift_both_ways, 2, BOTH)
    np.testing.assert_array_equal(left, BOTH[LANES - 1 : -1], "of the second block")
    np.testing.assert_array_equal(right, BOTH[1 : LANES + 1], "of the first block")


@uncached
def keep_some(out, a, count):
    store(out, 0, keep_lanes(load(a, 0), count, fill(9.0)))


@pytest.mark.parametrize("count", range(LANES + 1))
def test_keep_lanes_replaces_what_follows_the_count(count):
    expected = np.where(np.arange(LANES) < count, FIRST, 9.0)
    np.testing.assert_array_equal(rows_of(keep_some, 1, FIRST, count)[0], expected)


@uncached
def fill_from_place(out, a, place):
    store(out, 0, fill_from(a, place))


@pytest.mark.parametrize("place", range(LANES))
def test_fill_from_repeats_one_number_of_an_array(place):
    np.testing.assert_array_equal(rows_of(fill_from_place, 1, FIRST, place)[0], FIRST[place])


# --- Magnitudes ---


@uncached
def larger_of_vectors(out, a, b):
    store(out, 0, larger_magnitude(load(a, 0), load(b, 0)))


@uncached
def largest_of_vector(a):
    return largest_lane(load(a, 0))


def larger_of_numbers(a, b):
    return math.nan if math.isnan(a) or math.isnan(b) else max(abs(a), abs(b))


def test_the_larger_magnitude_is_found_in_each_lane_and_nan_wins():
    for first, second in itertools.product(LARGE, LARGE):
        a, b = np.array([first, 1.0, second, 1.0] * 2), np.array([second, 2.0, first, -2.0] * 2)
        expected = [larger_of_numbers(first, second), 2.0] * 4
        computed = rows_of(larger_of_vectors, 1, a, b)[0]
        np.testing.assert_array_equal(computed, expected, err_msg=f"{first} and {second}")


@pytest.mark.parametrize("largest", [-1e-320, 2.0, -np.inf, np.nan, -np.nan])
def test_the_largest_lane_is_found_wherever_it_is(largest):
    for lane in range(LANES):
        values = np.zeros(LANES)
        values[(lane + 1) % LANES] = np.inf if np.isnan(largest) else 0.0
        values[lane] = largest
        np.testing.assert_equal(largest_of_vector(values), abs(largest), err_msg=f"lane {lane}")


@given(st.lists(st.floats(allow_nan=False), min_size=1, max_size=40), st.integers(0, 39))
def test_the_largest_magnitude_of_an_array_is_nan_of_either_sign_where_there_is_one(values, place):
    """Zero by zero makes a NaN with the sign bit set on some processors."""
    assert largest_magnitude(np.array(values)) == max(map(abs, values))
    values[place % len(values)] = np.copysign(np.nan, 0.5 - place % 2)
    assert np.isnan(largest_magnitude(np.array(values)))


def test_ghosts_and_later_rows_do_not_count_as_largest():
    scratch = np.full((4, 5), 9.0)
    scratch[:2, 1:-1] = [[1, 2, 3], [3, 2, 4]]
    assert largest_in_rows(scratch, 2) == 4


# --- Views ---


@uncached
def shape_of_view(state):
    return vector_views((state,))[0].shape


@uncached
def read_view(out, state, row, j):
    store(out, 0, vector_views((state,))[0][row, j])


@uncached
def write_view(state, row, j):
    vector_views((state,))[0][row, j] = fill(1.0)


@pytest.mark.parametrize(("row", "j"), [(0, 0), (0, 3), (2, 1), (2, 7)])
def test_a_view_reads_and_writes_as_many_columns_of_a_row_and_nothing_else(row, j):
    state, lanes = np.arange(45.0).reshape(3, 15), (row, slice(j, j + LANES))
    assert shape_of_view(state) == state.shape
    np.testing.assert_array_equal(rows_of(read_view, 1, state, row, j)[0], state[lanes])
    expected = state.copy()
    expected[lanes] = 1.0
    write_view(state, row, j)
    np.testing.assert_array_equal(state, expected)


def write_sum(y, j):
    """Write the sum of two rows; one column of an array, or a vector of a view."""
    y[2, j] = y[0, j] + 0.5 * y[1, j]


write_sum_compiled = uncached(write_sum)


@uncached
def write_sum_by_views(first, second, j):
    views = vector_views((first, second))
    write_sum_compiled(views[0], j)
    write_sum_compiled(views[1], j)


def test_what_is_written_for_one_site_serves_for_a_vector_of_each_state():
    states = np.random.default_rng(0).normal(size=(2, 3, LANES + 5))
    by_view = states.copy()
    write_sum_by_views(*by_view, 3)
    for state in states:
        for j in range(3, 3 + LANES):
            write_sum_compiled(state, j)
    np.testing.assert_array_equal(by_view, states)
