"""The solvers by name: each integrator with the equations of the chain, compiled and cached."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from latticode.generation.chain import can_be_tiled
from latticode.integrators import crank_nicolson, dop853, ode45, taylor
from latticode.kernels.compiled import kernel

from pendula.models.amplitudes import chain_of_tile, continue_series, midpoint_rates, rates

from .lattice import aligned
from .observables import observe

solve_ode45 = ode45.build(rates, observe)
solve_ode45_real = ode45.build(rates, observe, of_reals=True)
solve_dop853 = dop853.build(rates, observe, can_be_tiled, chain_of_tile)
solve_crank_nicolson = crank_nicolson.build(rates, observe)
solve_delfour_fortin_payre = crank_nicolson.build_conserving(midpoint_rates, observe)
solve_taylor = taylor.build(continue_series, observe)


@kernel
def run_ode45(chain, y, times, controls, work, record, stop):
    return solve_ode45(chain, y, times, controls, work, record, stop)


@kernel
def run_ode45_real(chain, y, times, controls, work, record, stop):
    return solve_ode45_real(chain, y, times, controls, work, record, stop)


@kernel
def run_dop853(chain, y, times, controls, work, record, stop):
    return solve_dop853(chain, y, times, controls, work, record, stop)


@kernel
def run_crank_nicolson(chain, y, times, controls, work, record, stop):
    return solve_crank_nicolson(chain, y, times, controls, work, record, stop)


@kernel
def run_delfour_fortin_payre(chain, y, times, controls, work, record, stop):
    return solve_delfour_fortin_payre(chain, y, times, controls, work, record, stop)


@kernel
def run_taylor(chain, y, times, controls, work, record, stop):
    return solve_taylor(chain, y, times, controls, work, record, stop)


class Solver(NamedTuple):
    """A compiled run, the names of its controls in their order, and the number of work arrays.

    `tiled` gives the smaller number of a chain of so many sites that may go in tiles.
    """

    run: Callable
    controls: tuple[str, ...]
    work: int
    tiled: Callable[[int], int] | None = None

    def room_for(self, chain, y: np.ndarray) -> np.ndarray:
        """Return the work arrays for a state (row, 1 + site) of `chain`."""
        tiled = self.tiled and can_be_tiled.py_func(chain)
        count = self.tiled(y.shape[1] - 2) if tiled else self.work
        return aligned((count, *y.shape))


ITERATED = "step", "tolerance", "iterations"
"""The controls of the schemes that are solved by fixed-point iteration."""

SOLVERS = {
    "ode45": Solver(run_ode45, ("rtol", "atol"), ode45.WORK),
    "ode45_real": Solver(run_ode45_real, ("rtol", "atol"), ode45.WORK),
    "crank_nicolson": Solver(run_crank_nicolson, ITERATED, crank_nicolson.WORK),
    "delfour_fortin_payre": Solver(run_delfour_fortin_payre, ITERATED, crank_nicolson.WORK),
    "dop853": Solver(run_dop853, ("rtol", "atol"), dop853.WORK, dop853.work_arrays),
    "taylor": Solver(run_taylor, ("rtol", "atol"), taylor.WORK),
}
