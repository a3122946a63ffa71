"""Fixtures of several tests, and settings of hypothesis: fixed examples, no time limit.

Tests of figures draw small made-up datasets with the form of simulated ones.
"""

import fcntl
import os
from contextlib import chdir
from pathlib import Path

import numpy as np
import pendula.names  # noqa: F401, so that datasets have the paper's words
import pytest
import xarray as xr
from helpers import MY_BASELINE, ROOT, snakemake
from hypothesis import settings

settings.register_profile(
    "project", deadline=None, derandomize=True, database=None, max_examples=50
)
settings.load_profile("project")


@pytest.fixture(scope="session", autouse=True)
def _away_from_the_users_results(tmp_path_factory):
    """Run each test in an empty folder, because the project's may have results of a user."""
    with chdir(tmp_path_factory.mktemp("empty")):
        yield


@pytest.fixture(scope="session")
def made_once(tmp_path_factory):
    """Return a function for folders that `make` fills; one worker fills each folder for all.

    The folders are in PENDULA_FULL_RUN, if this is set, so that later sessions can use them too.
    """
    parallel = "PYTEST_XDIST_WORKER" in os.environ
    base = tmp_path_factory.getbasetemp()
    named_folder = os.environ.get("PENDULA_FULL_RUN")
    shared = Path(named_folder) if named_folder else (base.parent if parallel else base)

    def provide(name, make):
        directory = shared / name
        directory.mkdir(parents=True, exist_ok=True)
        with open(shared / f"{name}.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not (shared / f"{name}.done").exists():
                make(directory)
                (shared / f"{name}.done").touch()
        return directory

    return provide


@pytest.fixture(scope="session")
def full_run(made_once) -> Path:
    """Return a folder with a full run of config/quick.yaml, its archive and its own baseline."""

    def make(directory):
        targets = ("all", "archive", "accept_figures")
        result = snakemake(ROOT, directory, *targets, "--config", f"baseline={MY_BASELINE}")
        assert result.returncode == 0, result.stdout + result.stderr

    return made_once("full_run", make)


# --- Made-up datasets ----------------------------------------------------------------------------

PARAMETERS = {
    "epsilon": 1.0,
    "gamma": 1.0,
    "half_width": 2,
    "boundary": "dirichlet",
    "output_step": 0.5,
    "initial": '{"0": [1.0, 0.1]}',
}


def variable(dims, values, name):
    return dims, values, {"long_name": name, "units": "1"}


@pytest.fixture(scope="session")
def make_trajectory():
    """Return a function for trajectories of 11 times and 5 sites; curves grow with `scale`."""

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
        "ode45": 1.001,
        "ode45_real": 1.0,
        "crank_nicolson": 1.02,
        "crank_nicolson_halved": 1.005,
        "taylor": 1.0,
    }
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
