"""Trajectories and sweeps as datasets: variables, and attributes that say what was solved."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from latticode.simulation.integration import Words
from latticode.simulation.problem import Problem, name_window
from latticode.simulation.simulate import Trajectory
from latticode.simulation.sweep import STATISTICS
from latticode.simulation.systems import integration_of

from .netcdf import Variable
from .registry import NAMES
from .stated import describe_run

Contents = tuple[dict[str, Variable], dict[str, Any]]
"""The variables and the attributes of a dataset."""


def trajectory_contents(name: str, problem: Problem, trajectory: Trajectory) -> Contents:
    """Return the contents of the dataset on a run of `problem`."""
    words = integration_of(problem).words
    variables = trajectory_variables(problem, trajectory)
    if words.keeps_final:
        variables |= final_state(problem, trajectory)
    if trajectory.conserved:
        variables |= _conserved(trajectory)
    attributes = describe_run(name, problem, trajectory.solver)
    title = f"{words.measured} of {name} against time, by {trajectory.solver['name']}"
    return variables, {"title": title, **attributes, **count_work(trajectory.outcome[-3:])}


def trajectory_variables(problem: Problem, trajectory: Trajectory) -> dict[str, Variable]:
    """Return the norms, the energy if there is one, and what the run kept of its snapshots."""
    model, every = integration_of(problem), len(trajectory.snapshot_tau)
    words = model.words
    variables = {
        "tau": Variable(("tau",), trajectory.tau),
        "component": Variable(("component",), list(model.components), words.component),
        "linf": _norm("linf", ("component", "tau"), trajectory.linf, words),
        "l2": _norm("l2", ("component", "tau"), trajectory.l2, words),
    }
    if trajectory.energy.size:
        variables["energy"] = Variable(("tau",), trajectory.energy)
    if every:
        grid, moduli = ("component", "site", "snapshot"), trajectory.modulus.astype(np.float32)
        variables |= {
            "site": _sites(trajectory.modulus.shape[1]),
            "snapshot_tau": Variable(("snapshot",), trajectory.snapshot_tau),
            "modulus": Variable(grid, moduli, words.modulus, words.units),
        }
    if every and problem.keep == "state":
        variables |= {
            "part": Variable(("part",), list(model.parts), words.part),
            "state": Variable(("part", *grid), trajectory.state, words.state, words.units),
        }
    return variables


def _norm(name: str, axes: tuple[str, ...], values: np.ndarray, words: Words) -> Variable:
    return Variable(axes, values, words.norms and f"{NAMES[name]}{words.norms}", words.units)


def _sites(count: int) -> Variable:
    return Variable(("site",), np.arange(-(count // 2), count // 2 + 1))


def _conserved(trajectory: Trajectory) -> dict[str, Variable]:
    kept, values = list(trajectory.conserved), np.array([*trajectory.conserved.values()])
    grid = ("conserved_quantity", "tau")
    return {
        "conserved_quantity": Variable(grid[:1], kept, "conserved quantity"),
        "conserved": Variable(grid, values, "sum of its density over the chain"),
    }


def final_state(problem: Problem, trajectory: Trajectory) -> dict[str, Variable]:
    """Return the state at the end time: both parts of each field, (part, component, site)."""
    model, final = integration_of(problem), trajectory.final
    words = model.words
    if final.ndim == 2:
        final = np.stack([final.real, final.imag])
    grid = ("part", "component", "site")
    return {
        "site": _sites(final.shape[-1]),
        "part": Variable(("part",), list(model.parts), words.part),
        "final": Variable(grid, final, words.final, words.units),
    }


def sweep_contents(
    name: str,
    problem: Problem,
    half_widths: Iterable[int],
    windows: Iterable[tuple[float, float]],
    sweep: Mapping[str, np.ndarray],
) -> Contents:
    """Return the contents of the dataset on a sweep of `problem` over half-widths."""
    axes, model = ("half_width", "quantity", "statistic", "window"), integration_of(problem)
    variables = {
        "half_width": Variable(("half_width",), np.asarray(half_widths)),
        "quantity": Variable(("quantity",), [*model.components, "pair"]),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "l2": _norm("l2", axes, sweep["l2"], model.words),
        "linf": _norm("linf", axes, sweep["linf"], model.words),
    }
    attributes = describe_run(name, problem, problem.solver)
    del attributes["half_width"]
    title = f"Norms of {name} against the half-width, by {problem.solver['name']}"
    return variables, {"title": title, **attributes, **count_work(sweep["work"])}


def count_work(counts: Sequence) -> dict[str, int]:
    """Return the work of one run (3,), or of many (run, 3), as attributes."""
    names = "steps", "rejected_steps", "right_hand_sides"
    return dict(zip(names, np.reshape(counts, (-1, 3)).sum(axis=0).tolist(), strict=True))
