"""Functions that are translated in one pass compute what numba's own compiler computes."""

import numpy as np
import pytest
from latticode.kernels.compiled import in_one_pass, inlined_by_llvm, uncached
from latticode.kernels.simd import fill, load, store
from numba.core.errors import NumbaError

SHIFT = 3


@inlined_by_llvm
def halves(x, k):
    return 0.5 * x, k // 2


def write_sums(values, out, offset, is_even):
    total, last = 0.0, values.shape[0] - 1
    for k in range(last, -1, -1):
        half, by = halves(values[k, 1], k)
        if by % 2 == 0 and not is_even:
            total = total - half / (k + 1)
        else:
            for j in range(1, by):
                total += (1.0 * j) * values[min(j, last), 0]
        out[k] = -total if k > SHIFT or is_even else total + offset
    wide = fill(total) * load(values, 0)
    store(out, last + 1, 2.0 * wide - load(values, 1))


@uncached
def first_below(values, limit):
    for k in range(values.shape[0]):
        if values[k, 0] < limit:
            return k
    return -1


def write_searches(values, out, offset, is_even):
    k = passes = 0
    while True:
        passes += 1
        if passes % 3 == 0:
            continue
        limit = 0.5 * passes - 2.0
        found = first_below(values, limit)
        out[k] = values[found, 1] if 0 <= found < 9 and not is_even else limit
        for step in (1, passes % 2):
            k += step
        if passes in (10, 11) or k >= 16:
            break
    out[-1] += max(values[0, 0], offset, -1.0) + values.reshape(-1)[2:5].size


def write_rows(values, out, offset, is_even):
    column, flat = values[:, 1], values.reshape(-1)
    for k in range(-2, 3):  # a negative index counts from the end
        row = values[k]
        out[k] = row[0] + offset * values[k - 1, -1]
        out[3 + k] += column[k] - flat[-1] * values[2:][k - 3, 1]
    out[7] = values[1].reshape(-1)[-2] + flat.size + values[0].shape[0]


def write_last(values, out, offset, is_even):
    for k in range(values.shape[0]):  # names that only a loop assigns can be read after it
        last = values[k, 0] + offset
        out[k] = last
    if is_even:
        k = 11
    out[k + 1] = last


def filled(written, offset, is_even):
    """Return what a function of this module writes."""

    @uncached
    def run(values, out, offset, is_even):
        written(values, out, offset, is_even)

    values, out = np.random.default_rng(1).normal(size=(10, 2)), np.zeros(18)
    run(values, out, offset, is_even)
    return out


@pytest.mark.parametrize("written", [write_sums, write_searches, write_rows, write_last])
@pytest.mark.parametrize(("offset", "is_even"), [(0.25, True), (0.25, False), (2, False)])
def test_a_translated_function_has_the_bits_of_a_compiled_one(written, offset, is_even):
    translated = filled(in_one_pass(written), offset, is_even)
    np.testing.assert_array_equal(translated, filled(uncached(written), offset, is_even))
    assert np.count_nonzero(translated) > 6


def test_a_statement_outside_the_language_is_rejected_by_its_text():
    @in_one_pass
    def deleted(values, out, offset, is_even):
        del offset

    with pytest.raises((NotImplementedError, NumbaError), match="del offset"):
        filled(deleted, 1.0, False)


def test_an_expression_outside_the_language_is_rejected_by_its_text():
    @in_one_pass
    def listed(values, out, offset, is_even):
        out[0] = [offset][0]

    with pytest.raises((NotImplementedError, NumbaError), match=r"\[offset\]"):
        filled(listed, 1.0, False)


def test_a_name_that_changes_its_type_is_rejected():
    @in_one_pass
    def mixed(values, out, offset, is_even):
        total = 0
        if is_even:
            total = offset
        out[0] = total

    with pytest.raises((NotImplementedError, NumbaError), match="total changes from int64"):
        filled(mixed, 1.0, False)


def test_only_contiguous_arrays_get_a_single_dimension():
    @in_one_pass
    def flattened(values, out, offset, is_even):
        out[0] = values[:, 0].reshape(-1)[1]

    with pytest.raises((NotImplementedError, NumbaError), match=r"reshape\(-1\) of array"):
        filled(flattened, 1.0, False)
