"""A trajectory as a dataset."""

from collections.abc import Mapping

import numpy as np

from pendula import __version__
from pendula.problem import Problem, write_initial
from pendula.simulation.simulate import Trajectory

from .netcdf import Variable

COMPONENTS = Variable(("component",), ["A", "B"], "pendulum of each pair")


def contents(name: str, problem: Problem, trajectory: Trajectory) -> tuple[dict, dict]:
    """Return (variables, attributes) of the dataset that a run of `problem` makes."""
    attributes = as_attributes(name, problem, trajectory.solver)
    work = count_work([trajectory.outcome])
    return as_variables(trajectory, problem.snapshot_every), {**attributes, **work}


def as_variables(trajectory: Trajectory, snapshot_every: int) -> dict[str, Variable]:
    """Return the variables of a trajectory's dataset."""
    series = ("component", "tau")
    variables = {
        "tau": Variable(("tau",), trajectory.tau, "slow time"),
        "component": COMPONENTS,
        "linf": Variable(series, trajectory.linf, "l-infinity norm over the chain"),
        "l2": Variable(series, trajectory.l2, "l2 norm over the chain"),
        "energy": Variable(("tau",), trajectory.energy, "conserved energy H of equation (8)"),
    }
    if snapshot_every:
        reach = trajectory.modulus.shape[1] // 2
        variables |= {
            "site": Variable(("site",), np.arange(-reach, reach + 1), "site of the chain"),
            "snapshot_tau": Variable(
                ("snapshot",), trajectory.tau[::snapshot_every], "slow time of the snapshots"
            ),
            "modulus": Variable(
                ("component", "site", "snapshot"),
                trajectory.modulus.astype(np.float32),
                "modulus of the amplitude on a site",
            ),
        }
    return variables


def as_attributes(name: str, problem: Problem, solver: Mapping) -> dict:
    """Return the attributes that say what was solved, and by which controls: no dates, no hosts."""
    values = problem.plain()
    plain = {key: values[key] for key in sorted(values) if key not in ("solver", "initial")}
    return {
        "case": name,
        **plain,
        "initial": write_initial(values["initial"]),
        "solver": solver["name"],
        **{f"solver_{key}": value for key, value in solver.items() if key != "name"},
        "version": __version__,
    }


def count_work(outcomes: list) -> dict:
    """Return the work of one run, or of many, as attributes."""
    return {
        "steps": sum(outcome.steps for outcome in outcomes),
        "rejected_steps": sum(outcome.rejected for outcome in outcomes),
        "right_hand_sides": sum(outcome.evaluations for outcome in outcomes),
    }
