"""What generated kernels take from the library, and the system that they are given.

A generated module imports all of this. It stands in a file, so that a change of any of it compiles
the kernels again and reruns the jobs that call them.
"""
# ruff: noqa: F401

from typing import NamedTuple

import numpy as np

from pendula.compiled import inlined_by_llvm, kernel
from pendula.integrators import taylor
from pendula.integrators.taylor import EXTRA, ORDER, ORDER_STRIDE, X, Y, block_start, spare_start
from pendula.simd import (
    LANES,
    define_shift,
    fill,
    left_neighbours,
    load,
    right_neighbours,
    store,
)

from .chain import at_every_site, close, widen
from .series import in_waves, sides_of
from .sines import sine_and_cosine


class System(NamedTuple):
    """What the kernels of any traced model are given."""

    constants: tuple[float, ...]
    clocks: tuple[float, ...]  # the functions of the time, and behind them their derivatives
    at: np.ndarray  # (row, 1 + site), parameters that depend on the site, with room for a vector
    wide: np.ndarray  # (row, reach + site), room for a state with more ghost columns
    left: int
    right: int
