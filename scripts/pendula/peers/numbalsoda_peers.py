"""numbalsoda's DOP853 (Hairer's, in Fortran) on a compiled right-hand side."""

from functools import partial
from importlib.util import find_spec

import numba
import numpy as np
from numba import types

from pendula.simulation.lattice import WHOLE

from .problem import (
    HALF,
    Peer,
    Problem,
    Solve,
    amplitudes_of,
    chain_of,
    check,
    flat_rates,
    flat_state,
    timed,
)


def why_absent() -> str | None:
    """Return what is missing."""
    return None if find_spec("numbalsoda") else "the Python package numbalsoda is not installed"


def callback(chain, size: int):
    """Return the right-hand side of vectors of `size` numbers as a C function."""
    pointer = types.CPointer(types.float64)

    @numba.cfunc(types.void(types.float64, pointer, pointer, pointer), error_model="numpy")
    def rates(tau, u, slope, nothing):
        flat_rates(chain, numba.carray(u, (size,)), numba.carray(slope, (size,)))

    return rates


def prepare(problem: Problem, reduction) -> Solve:
    """Return DOP853 on the library's real state of the whole or of half the chain."""
    check(problem, reduction.even)
    from numbalsoda import dop853

    start = flat_state(problem, reduction)
    rates = callback(chain_of(problem, reduction), start.size)
    times = np.array([0.0, problem.end_time])
    nothing = np.zeros(1)

    def solve(rtol):
        (u, success), seconds = timed(
            lambda: dop853(rates.address, start, times, data=nothing, rtol=rtol, atol=rtol)
        )
        if not success:  # it then returns plausible numbers all the same
            raise RuntimeError("numbalsoda's dop853 gave up")
        return amplitudes_of(u[-1], reduction), seconds

    solve(1e-3)  # compiles the driver
    return solve


WHOLE_CHAIN = Peer("numbalsoda DOP853, whole chain", why_absent, partial(prepare, reduction=WHOLE))
HALF_CHAIN = Peer("numbalsoda DOP853, half chain", why_absent, partial(prepare, reduction=HALF))
