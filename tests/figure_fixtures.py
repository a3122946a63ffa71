"""Small made-up datasets of the form that the simulations write: the plots need no simulation."""

import numpy as np
import pytest
import xarray as xr

HALF_WIDTHS = [5, 10, 20]
PARAMETERS = {
    "epsilon": 1.0,
    "gamma": 1.0,
    "half_width": 2,
    "boundary": "dirichlet",
    "output_step": 0.5,
    "initial": '{"0": [1.0, 0.1]}',
}
WINDOWS = ["[10, 50]", "[10, 70]", "[10, 40]"]


def variable(dims, values, name):
    return dims, values, {"long_name": name, "units": "1"}


@pytest.fixture(scope="session")
def make_trajectory():
    """Return a function: a trajectory of 11 times, 5 sites, whose curves grow like `scale`."""

    def make(case="fig2_small", omega=8.0, scale=1.0, solver="ode45", end_time=5.0):
        tau = np.linspace(0, end_time, 11)
        norms = scale * np.array([2 + np.cos(tau), 1 + np.sin(tau) ** 2])
        modulus = norms[:, None, ::2] * np.exp(-np.abs(np.arange(-2, 3)))[None, :, None]
        return xr.Dataset(
            {
                "linf": variable(("component", "tau"), norms, "l-infinity norm"),
                "l2": variable(("component", "tau"), 3 * norms, "l2 norm"),
                "energy": variable("tau", 7 - 1e-7 * scale * tau, "energy"),
                "modulus": variable(("component", "site", "snapshot"), modulus, "modulus"),
                "snapshot_tau": variable("snapshot", tau[::2], "slow time of the snapshots"),
            },
            {
                "tau": variable("tau", tau, "slow time"),
                "component": variable("component", ["A", "B"], "component"),
                "site": variable("site", np.arange(-2, 3), "site"),
            },
            PARAMETERS | {"case": case, "omega": omega, "solver": solver},
        )

    return make


@pytest.fixture(scope="session")
def trajectories(make_trajectory):
    """Return two cases by solvers; the second solver is 2 % off from the start."""
    scales = {
        "ode45": 1.001, "ode45_real": 1.0, "crank_nicolson": 1.02, "crank_nicolson_halved": 1.005,
        "taylor": 1.0,
    }  # fmt: skip
    runs = {
        case: {
            solver: make_trajectory(case, scale=scale, solver=solver)
            for solver, scale in scales.items()
        }
        for case in ("fig2_small", "fig2_large")
    }
    for by_solver in runs.values():
        for step, name in ((0.5, "crank_nicolson"), (0.25, "crank_nicolson_halved")):
            by_solver[name].attrs["solver_step"] = step
    return runs


@pytest.fixture(scope="session")
def make_sweep():
    """Return a function: a sweep whose every number tells where in the dataset it stands."""

    def make(omega=-4.0, case="fig5_left"):
        dims = ("half_width", "quantity", "statistic", "window")
        coordinates = (HALF_WIDTHS, ["A", "B", "pair"], ["max", "mean"], WINDOWS)
        shape = tuple(len(values) for values in coordinates)
        l2 = 1.0 + np.arange(np.prod(shape)).reshape(shape)
        return xr.Dataset(
            {"l2": variable(dims, l2, "l2 norm"), "linf": variable(dims, l2 / 100, "linf norm")},
            {
                dim: variable(dim, values, dim)
                for dim, values in zip(dims, coordinates, strict=True)
            },
            {key: PARAMETERS[key] for key in ("epsilon", "gamma", "boundary", "initial")}
            | {"omega": omega, "case": case, "solver": "ode45"},
        )

    return make
