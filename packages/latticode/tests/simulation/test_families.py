"""auto and check judge a method by one of another family, so that its own faults are seen."""

import numpy as np
import pytest
from latticode import Case, Model, lap, simulate, sin, sqrt
from latticode.checks import run_again
from latticode.datasets.netcdf import as_xarray
from latticode.datasets.trajectories import trajectory_contents
from latticode.integrators.families import other_family
from latticode.simulation import simulate as simulation
from latticode.simulation.equations import IntegrationError
from latticode.simulation.traced import TracedEquations
from numpy_lattice import slope_of, solution, traced
from planted import EXTRA_TURN, problem, with_wrong
from scipy.integrate import solve_ivp

AUTO = {"name": "auto", "error": 1e-9}


def true_final(case):
    """Return the fields at the end of a run of the planted lattice, by SciPy on plain NumPy."""

    def rate(t, u):
        lap_u = np.append(u[1:], u[-1]) - 2 * u + np.append(u[:1], u[:-1])
        return -1j * (lap_u + np.abs(u) ** 2 * u)

    start = case.amplitudes[0]
    return solve_ivp(rate, (0, case.end_time), start, method="DOP853", rtol=1e-12, atol=1e-13).y.T[
        -1
    ]


# --- auto


def test_auto_leaves_a_taylor_method_whose_phases_alone_are_wrong():
    case = problem(with_wrong("taylor"), solver=AUTO)
    trajectory = simulation.simulate(case)
    assert trajectory.solver["name"] == "dop853" and trajectory.solver["agrees_with"] == "ode45"
    assert "taylor and dop853 differ by 5" in trajectory.solver["disagreement"]
    error = np.abs(trajectory.final[0] - true_final(case)).max() / trajectory.linf.max()
    assert error < trajectory.solver["estimated_error"] <= AUTO["error"]


def test_auto_raises_where_no_third_method_can_decide():
    case = problem(with_wrong("dop853", equations=WithoutTaylor), solver=AUTO)
    with pytest.raises(IntegrationError, match=r"dop853 and ode45 differ by .* no third method"):
        simulation.simulate(case)


def test_auto_raises_where_three_methods_follow_three_motions():
    equations = with_wrong("ode45", equations=with_wrong("taylor"), rate=-EXTRA_TURN)
    case = problem(equations, solver=AUTO)
    with pytest.raises(IntegrationError, match="and ode45 agrees with neither; allow a larger"):
        simulation.simulate(case)


class WithoutTaylor(TracedEquations):
    """Equations without a power series."""

    @property
    def methods(self):
        return [name for name in super().methods if name != "taylor"]


PHASES = Model(
    fields="u",
    parameters={"w": lambda n: 0.1 * n},
    i_dt=lambda p, u: 1j * (p.w + sin(u.right.real - u.real) + sin(u.left.real - u.real)),
)
CHAIN = Model(fields="x", parameters={}, d2_dt2=lambda p, x: lap(x) - sin(x))
DRAG = Model(fields="x", parameters={}, d2_dt2=lambda p, x, v: lap(x) - sin(x) - sqrt(v * v) * v)


@pytest.mark.parametrize("model", [PHASES, CHAIN, DRAG])
@pytest.mark.parametrize("error", [1e-4, 1e-9])
def test_the_stated_error_bounds_the_true_one_whether_or_not_there_is_a_series(model, error):
    case = Case(model=model, half_width=4, boundary="free", initial={0: [1], 1: [0.4]}, end_time=20)
    run = simulate(case.changed(solver={"name": "auto", "error": error}))
    n = np.arange(-4, 5)
    start = np.zeros((2, 9))
    start[0, 4:6] = 1.0, 0.4

    def rate(t, flat):
        x, v = flat.reshape(2, 9)
        right, left = np.append(x[1:], x[-1]), np.append(x[:1], x[:-1])
        if model is PHASES:
            return np.ravel([0.1 * n + np.sin(right - x) + np.sin(left - x), 0.0 * v])
        drag = np.abs(v) * v if model is DRAG else 0.0
        return np.ravel([v, right - 2 * x + left - np.sin(x) - drag])

    exact = solve_ivp(rate, (0, 20), start.ravel(), method="DOP853", rtol=1e-13, atol=1e-13).y.T[-1]
    off = np.abs(run["final"].values[:, 0] - exact.reshape(2, 9)).max() / float(run["linf"].max())
    assert off < run.attrs["solver_estimated_error"] <= error


@pytest.mark.parametrize("boundary", ["free", "antiperiodic"])
@pytest.mark.parametrize("rate", ["a / (1 + abs2(b.left))", "a * sin(b.left.real - a.real)"])
def test_the_stated_error_bounds_that_of_functions_of_neighbours_next_to_ends(rate, boundary):
    """Here series were wrong by 1e-3, and the stated error was 5e-11."""
    text = f"def i_dt(p, a, b):\n    return {rate}, lap(b)\n"
    model = Model(fields=("a", "b"), parameters={}, i_dt=traced(text)["i_dt"], text=text)
    start = np.random.default_rng(1).normal(size=(2, 11, 2)) @ (0.4, 0.4j)
    solver = {"name": "auto", "error": 1e-8}
    case = problem(
        model=model, half_width=5, boundary=boundary, initial=start, end_time=5.0, solver=solver
    )
    run = simulation.simulate(case)
    expected = solution(slope_of(text, {}, boundary, 2, "i_dt"), start.ravel(), 5.0)
    error = np.abs(run.final.ravel() - expected).max() / run.linf.max()
    assert error < run.solver["estimated_error"] <= 1e-8


# --- check


def dataset(case):
    """Return the run of a problem as `simulate` of a notebook does."""
    return as_xarray(*trajectory_contents("run", case, simulation.simulate(case)))


def test_check_reports_phases_that_are_wrong_though_all_norms_are_right():
    case = problem(with_wrong("taylor"), snapshot_every=5)
    checked = run_again(case, dataset(case))
    assert float(checked["difference"].max()) < 1e-11 and checked.attrs["second_name"] == "dop853"
    expected = 2 * np.sin(0.5 * EXTRA_TURN * checked["kept_tau"])
    scale = checked["field_difference"] / expected.where(expected > 0)
    assert ((scale > 0.3) | scale.isnull()).all() and (scale.max() <= 1.001)
    assert float(checked["largest_difference"]) == float(checked["field_difference"].max())
    slow = problem(with_wrong("taylor"), snapshot_every=20, end_time=30.0)
    assert 10.0 <= float(run_again(slow, dataset(slow))["divergence_time"]) <= 24.0


def test_check_judges_the_fields_of_the_run_that_it_is_given():
    case = problem(snapshot_every=10)
    run = dataset(case)
    assert float(run_again(case, run)["largest_difference"]) < 1e-11
    run["final"] = -run["final"]
    assert float(run_again(case, run)["largest_difference"]) > 0.5


@pytest.mark.parametrize("solver", ["taylor", "dop853", "ode45", "crank_nicolson", "kahan_li"])
@pytest.mark.parametrize("known", [("taylor", "dop853", "ode45"), ("dop853", "ode45")])
def test_no_method_is_judged_by_itself(solver, known):
    assert other_family(solver, known) in set(known) - {solver}
