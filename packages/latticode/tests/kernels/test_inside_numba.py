"""A kernel and its parts: compiled once, together, and without memory of their own."""

from importlib.metadata import version

import numpy as np
import pytest
from latticode.kernels.compiled import TESTED, uncached
from latticode.kernels.inside_numba import SubroutineLibrary, make_kernel
from latticode.kernels.simd import largest_magnitude
from numba.core import event
from numba.core.errors import NumbaError


def test_the_numba_of_the_tests_is_one_that_was_looked_into():
    """What to do on the day when this fails stands at the top of inside_numba."""
    assert version("numba").rpartition(".")[0] in TESTED


@uncached
def double(x):
    return 2.0 * x


@uncached
def double_first(values):
    values[0] = double(values[0])
    return values


def test_a_part_has_no_machine_code_and_is_compiled_once_for_all_callers():
    @uncached
    def square(x):
        return x + 1.0

    @uncached
    def first(x):
        return square(x)

    @uncached
    def second(x):
        return square(x) + square(2.0 * x)

    with event.install_recorder("numba:compile") as compiled:
        assert (first(1.0), second(1.0)) == (2.0, 5.0)
    names = [record.data["dispatcher"].__name__ for _, record in compiled.buffer if record.is_start]
    assert sorted(names) == ["first", "second", "square"]
    assert not square.overloads  # Python has not called it
    (code,) = square.subroutine.overloads.values()
    assert isinstance(code.library, SubroutineLibrary)
    assert not code.library._codegen._engine.is_symbol_defined(code.fndesc.llvm_func_name)


def test_an_array_that_a_part_returns_stays_that_of_its_owner():
    @uncached
    def again_and_again(values, times):
        for _ in range(times):
            values = double_first(values)
        return values[0]

    values = np.ones(2)
    assert again_and_again(values, 50) == 2.0**50 and values[0] == 2.0**50
    del again_and_again
    assert values.sum() == 2.0**50 + 1.0


def test_a_kernel_that_asks_for_memory_is_refused():
    @uncached
    def hungry(count):
        return np.zeros(count).sum()

    with pytest.raises(NumbaError, match="Only accept returning of array"):
        hungry(3)


def test_parts_that_another_process_kept_make_the_same_kernel(tmp_path):
    def compile_anew():
        built = make_kernel(largest_magnitude.py_func, tmp_path)

        @uncached
        def caller(values):
            return built(values)

        return built.subroutine, caller(np.array([1.0, -3.0, 2.0]))

    first, second = compile_anew(), compile_anew()
    assert first[1] == second[1] == 3.0
    hits = [sum(component.stats.cache_hits.values()) for component, _ in (first, second)]
    assert hits == [0, 1]
    assert [path.suffix for path in tmp_path.rglob("*.*")] == [".part"]
