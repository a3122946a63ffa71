"""The solvers of Newton's equations (1) by name, compiled and cached as those of (4)."""

from latticode.generation.chain import can_be_tiled
from latticode.integrators import dop853, kahan_li, ode45, taylor
from latticode.kernels.compiled import kernel
from latticode.simulation.integration import Solver
from latticode.simulation.observables import observe_angles

from .pendula import WORK, at_time, continue_series, pendula_of_tile, rates

solve_ode45 = ode45.build(rates, observe_angles, at_time)
solve_dop853 = dop853.build(rates, observe_angles, can_be_tiled, pendula_of_tile, at_time)
solve_taylor = taylor.build(continue_series, observe_angles, at_time)
solve_kahan_li = kahan_li.build(rates, observe_angles, at_time)


@kernel
def run_ode45(pendula, y, times, controls, work, record, stop):
    return solve_ode45(pendula, y, times, controls, work, record, stop)


@kernel
def run_dop853(pendula, y, times, controls, work, record, stop):
    return solve_dop853(pendula, y, times, controls, work, record, stop)


@kernel
def run_taylor(pendula, y, times, controls, work, record, stop):
    return solve_taylor(pendula, y, times, controls, work, record, stop)


@kernel
def run_kahan_li(pendula, y, times, controls, work, record, stop):
    return solve_kahan_li(pendula, y, times, controls, work, record, stop)


SOLVERS = {
    "ode45": Solver(run_ode45, ("rtol", "atol"), ode45.WORK),
    "dop853": Solver(run_dop853, ("rtol", "atol"), dop853.WORK, dop853.work_arrays),
    "taylor": Solver(run_taylor, ("rtol", "atol"), WORK),
    "kahan_li": Solver(run_kahan_li, ("step",), kahan_li.WORK),
}
