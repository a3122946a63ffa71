"""Trajectories and sweeps as datasets: variables, and attributes that describe the problem."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from latticode.equations.initial_values import name_window
from latticode.simulation.equations import ResultNames
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import Trajectory
from latticode.simulation.sweep import STATISTICS

from .netcdf import Variable
from .registry import NAMES
from .stated import describe_run

Contents = tuple[dict[str, Variable], dict[str, Any]]
"""The variables and the attributes of a dataset."""


def trajectory_contents(name: str, problem: Problem, trajectory: Trajectory) -> Contents:
    """Return the contents of the dataset of a run of `problem`."""
    equations = problem.equations
    variables = trajectory_variables(problem, trajectory)
    if equations.stores_final:
        variables |= final_state(problem, trajectory)
    if trajectory.conserved and not equations.names.quantities:
        variables |= _conserved(trajectory)
    attributes = describe_run(name, problem, trajectory.solver)
    title = f"{equations.names.title} of {name} against time, by {trajectory.solver['name']}"
    return variables, {"title": title, **attributes, **count_work(trajectory.outcome[-3:])}


def trajectory_variables(problem: Problem, trajectory: Trajectory) -> dict[str, Variable]:
    """Return norms, conserved quantities that have their own variables, and snapshots."""
    names, every = problem.equations.names, len(trajectory.snapshot_tau)
    variables = {
        "tau": Variable(("tau",), trajectory.tau),
        "component": Variable(("component",), list(names.components), names.component),
        "linf": _norm("linf", ("component", "tau"), trajectory.linf, names),
        "l2": _norm("l2", ("component", "tau"), trajectory.l2, names),
    }
    for quantity in names.quantities:
        if quantity in trajectory.conserved:
            variables[quantity] = Variable(("tau",), trajectory.conserved[quantity])
    if every:
        grid, moduli = ("component", "site", "snapshot"), trajectory.modulus.astype(np.float32)
        variables |= {
            "site": _sites(problem, trajectory.modulus.shape[1]),
            "snapshot_tau": Variable(("snapshot",), trajectory.snapshot_tau),
            "modulus": Variable(grid, moduli, names.modulus, names.units),
        }
    if every and problem.keep == "state":
        variables |= {
            "part": Variable(("part",), list(names.parts), names.part),
            "state": Variable(("part", *grid), trajectory.state, names.state, names.units),
        }
    return variables


def _norm(name: str, axes: tuple[str, ...], values: np.ndarray, names: ResultNames) -> Variable:
    return Variable(axes, values, names.norms and f"{NAMES[name]}{names.norms}", names.units)


def _sites(problem: Problem, count: int) -> Variable:
    first = 0 if problem.site_count is not None else -(count // 2)
    return Variable(("site",), np.arange(first, first + count))


def _conserved(trajectory: Trajectory) -> dict[str, Variable]:
    names, values = list(trajectory.conserved), np.array([*trajectory.conserved.values()])
    grid = ("conserved_quantity", "tau")
    return {
        "conserved_quantity": Variable(grid[:1], names, "conserved quantity"),
        "conserved": Variable(grid, values, "sum of its density over the chain"),
    }


def final_state(problem: Problem, trajectory: Trajectory) -> dict[str, Variable]:
    """Return the state at the end time (part, component, site), with its coordinates."""
    names, final = problem.equations.names, trajectory.final
    if final.ndim == 2:
        final = np.stack([final.real, final.imag])
    grid = ("part", "component", "site")
    return {
        "site": _sites(problem, final.shape[-1]),
        "part": Variable(("part",), list(names.parts), names.part),
        "final": Variable(grid, final, names.final, names.units),
    }


def sweep_contents(
    name: str,
    problem: Problem,
    half_widths: Iterable[int],
    windows: Iterable[tuple[float, float]],
    sweep: Mapping[str, np.ndarray],
) -> Contents:
    """Return the contents of the dataset of a sweep of `problem` over half-widths."""
    axes, names = ("half_width", "quantity", "statistic", "window"), problem.equations.names
    variables = {
        "half_width": Variable(("half_width",), np.asarray(half_widths)),
        "quantity": Variable(("quantity",), [*names.components, "pair"]),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "l2": _norm("l2", axes, sweep["l2"], names),
        "linf": _norm("linf", axes, sweep["linf"], names),
    }
    attributes = describe_run(name, problem, problem.solver)
    del attributes["half_width"]
    title = f"Norms of {name} against the half-width, by {problem.solver['name']}"
    return variables, {"title": title, **attributes, **count_work(sweep["work"])}


def count_work(counts: Sequence) -> dict[str, int]:
    """Return the total work as attributes, from counts (3,) of one run or (run, 3) of many."""
    names = "steps", "rejected_steps", "right_hand_sides"
    return dict(zip(names, np.reshape(counts, (-1, 3)).sum(axis=0).tolist(), strict=True))
