"""The solvers of (4) by name: each integrator with the equations, compiled and cached."""

from latticode.generation.chain import can_be_tiled
from latticode.integrators import crank_nicolson, dop853, ode45, taylor
from latticode.kernels.compiled import kernel
from latticode.simulation.integration import ITERATED, Solver
from latticode.simulation.observables import observe_moduli

from .amplitudes import (
    chain_of_tile,
    continue_series,
    energy_with_scratch,
    midpoint_rates,
    rates,
)


@kernel
def observe(chain, y, i, record):
    """Reduce the state `y` of (4) to the observables of output `i`, its energy among them."""
    observe_moduli(chain, y, i, record)
    if record.energy.size > 0:
        record.energy[i] = energy_with_scratch(chain, y, record.scratch)


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


SOLVERS = {
    "ode45": Solver(run_ode45, ("rtol", "atol"), ode45.WORK),
    "ode45_real": Solver(run_ode45_real, ("rtol", "atol"), ode45.WORK),
    "crank_nicolson": Solver(run_crank_nicolson, ITERATED, crank_nicolson.WORK),
    "delfour_fortin_payre": Solver(run_delfour_fortin_payre, ITERATED, crank_nicolson.WORK),
    "dop853": Solver(run_dop853, ("rtol", "atol"), dop853.WORK, dop853.work_arrays),
    "taylor": Solver(run_taylor, ("rtol", "atol"), taylor.WORK),
}
