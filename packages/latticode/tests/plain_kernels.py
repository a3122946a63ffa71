"""Lets kernels run as plain Python on NumPy's arrays, so that a model takes a second to try.

`python plain_kernels.py <first> <last>` judges the random models of these seeds. `install` must be
called before anything else of the library is imported. What is lost is the compiler: some models
must be compiled, too.
"""

import sys
from types import ModuleType

import numpy as np

LANES = 8


class View:
    """A state (row, column), of which an element is the vector that begins there."""

    def __init__(self, state):
        self.state, self.shape = state, state.shape

    def __getitem__(self, place):
        row, column = place
        return self.state[row, column : column + LANES].copy()

    def __setitem__(self, place, value):
        row, column = place
        self.state[row, column : column + LANES] = value


def store(array, index, value):
    array.reshape(-1)[index : index + LANES] = value


def define_shift(first):
    return lambda before, after: np.concatenate([before, after])[first : first + LANES]


def largest_in_rows(scratch, rows):
    return np.abs(scratch[:rows, 1:-1]).max(initial=0.0)


VECTORS = {
    "LANES": LANES,
    "fill": lambda number: np.full(LANES, float(number)),
    "fill_from": lambda array, index: np.full(LANES, array.reshape(-1)[index]),
    "load": lambda array, index: array.reshape(-1)[index : index + LANES].copy(),
    "store": store,
    "define_shift": define_shift,
    "right_neighbours": define_shift(1),
    "left_neighbours": define_shift(LANES - 1),
    "keep_lanes": lambda value, count, other: np.where(np.arange(LANES) < count, value, other),
    "larger_magnitude": lambda one, other: np.maximum(np.abs(one), np.abs(other)),
    "largest_lane": lambda value: np.abs(value).max(),
    "largest_magnitude": lambda values: np.abs(values).max(),
    "largest_in_rows": largest_in_rows,
    "vector_views": lambda states: tuple(map(View, states)),
    "square_root": np.sqrt,
    "TINY": 1e-150,
    "zero_below": lambda level, value: np.where(np.abs(value) < level, 0.0, value),
    "select_positive": lambda condition, one, other: np.where(condition > 0.0, one, other),
    "power_of_two": lambda k: np.exp2(np.clip(k, -1022, 1023)),
    "whole_exponent": lambda x: np.floor(np.log2(x) + 0.5),
}


def plain(function):
    """Return a function as it is, with the attribute by which a compiled one has it."""
    function.py_func = function
    return function


def copy(source, target):
    target[...] = source


def install():
    """Put these into the place of the library's decorators and vectors."""
    decorators = ("kernel", "uncached", "inlined_by_llvm", "in_one_pass")
    functions = {"copy": copy, "at_any_time": lambda system, t: system}
    modules = {"simd": VECTORS, "compiled": dict.fromkeys(decorators, plain) | functions}
    for name, contents in modules.items():
        module = ModuleType(f"latticode.kernels.{name}")
        module.__dict__.update(contents)
        sys.modules[module.__name__] = module


if __name__ == "__main__":
    install()
    from judge_models import print_faults

    print_faults(*map(int, sys.argv[1:]))
