"""Trajectories and sweeps as datasets: variables, and attributes that say what was solved."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from pendula.problem import PENDULA, Constants, Problem, name_window
from pendula.simulation.models import MODELS, model_of
from pendula.simulation.simulate import Trajectory
from pendula.simulation.sweep import STATISTICS, Sweep

from .netcdf import Variable
from .registry import NAMES
from .stated import describe_run, shared_by

COMPONENTS = Variable(("component",), ["A", "B"])
OF_PENDULA = Variable(("component",), list(MODELS[PENDULA].components))
PARTS = MODELS[PENDULA].parts
Contents = tuple[dict[str, Variable], dict[str, Any]]
"""The variables and the attributes of a dataset."""


def trajectory_contents(name: str, problem: Problem, trajectory: Trajectory) -> Contents:
    """Return the contents of the dataset on a run of `problem`."""
    variables, what = trajectory_variables(trajectory, problem.snapshot_every), "Norms and energy"
    if problem.model == PENDULA:
        variables, what = _of_pendula(variables, trajectory), "Norms of the angles"
    elif problem.is_own:
        variables, what = _of_own_model(variables, problem, trajectory), "Norms"
    attributes = describe_run(name, problem, trajectory.solver)
    title = f"{what} of {name} against time, by {trajectory.solver['name']}"
    return variables, {"title": title, **attributes, **count_work([trajectory.outcome])}


def trajectory_variables(trajectory: Trajectory, snapshot_every: int) -> dict[str, Variable]:
    """Return the norms and the energy, and the moduli where the run kept them."""
    variables = {
        "tau": Variable(("tau",), trajectory.tau),
        "component": COMPONENTS,
        "linf": Variable(("component", "tau"), trajectory.linf),
        "l2": Variable(("component", "tau"), trajectory.l2),
        "energy": Variable(("tau",), trajectory.energy),
    }
    if snapshot_every:
        grid = ("component", "site", "snapshot")
        variables |= {
            "site": _sites(trajectory.modulus.shape[1]),
            "snapshot_tau": Variable(("snapshot",), trajectory.tau[::snapshot_every]),
            "modulus": Variable(grid, trajectory.modulus.astype(np.float32)),
        }
    return variables


def _sites(count: int) -> Variable:
    return Variable(("site",), np.arange(-(count // 2), count // 2 + 1))


def _of_pendula(variables: dict[str, Variable], trajectory: Trajectory) -> dict[str, Variable]:
    """Return variables of pendula: norms of the angles, no energy, and the state at the end."""
    del variables["energy"]
    whose = dict.fromkeys(("linf", "l2"), ", of the angles")
    whose["modulus"] = ": the angle to which a pendulum swings"
    for name in variables.keys() & whose:
        about = f"{NAMES[name]}{whose[name]}"
        variables[name] = variables[name]._replace(long_name=about, units="rad")
    sites = _sites(trajectory.final.shape[-1])
    return variables | {"component": OF_PENDULA, "site": sites} | final_state(trajectory)


def _of_own_model(
    variables: dict[str, Variable], problem: Problem, trajectory: Trajectory
) -> dict[str, Variable]:
    """Return norms, moduli, what is conserved, and the state at the end, of a user's own model."""
    del variables["energy"]
    variables["component"] = Variable(("component",), list(problem.model.fields), "field")
    variables |= {"site": _sites(2 * problem.half_width + 1), **final_state(trajectory)}
    if problem.model.second_order:
        grid, about = ("part", "component", "site"), "value of a field, and its rate"
        variables["part"] = Variable(("part",), ["value", "rate"], about)
        variables["final"] = Variable(grid, trajectory.final, f"{about}, at the end time")
    if trajectory.conserved and problem.snapshot_every:
        kept, values = list(trajectory.conserved), np.array([*trajectory.conserved.values()])
        grid = ("conserved_quantity", "snapshot")
        variables |= {
            "conserved_quantity": Variable(grid[:1], kept, "conserved quantity"),
            "conserved": Variable(grid, values, "sum of its density over the chain"),
        }
    return variables


def final_state(trajectory: Trajectory) -> dict[str, Variable]:
    """Return the state at the end time: amplitudes, or angles and velocities of the pendula."""
    grid = ("part", "component", "site")
    if trajectory.final.ndim == 3:
        parts = Variable(("part",), list(PARTS), f"{NAMES['part']}, x + i x'")
        about = f"{NAMES['final']}, as angle and velocity of a pendulum"
        return {"part": parts, "final": Variable(grid, trajectory.final, about, "rad")}
    parts = [trajectory.final.real, trajectory.final.imag]
    return {"part": Variable(("part",), ["re", "im"]), "final": Variable(grid, parts)}


def sweep_contents(
    name: str,
    problem: Problem,
    half_widths: Iterable[int],
    windows: Iterable[tuple[float, float]],
    sweep: Sweep,
) -> Contents:
    """Return the contents of the dataset on a sweep of `problem` over half-widths."""
    axes = ("half_width", "quantity", "statistic", "window")
    variables = {
        "half_width": Variable(("half_width",), np.asarray(half_widths)),
        "quantity": Variable(("quantity",), [*model_of(problem).components, "pair"]),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "l2": Variable(axes, sweep.l2),
        "linf": Variable(axes, sweep.linf),
    }
    if problem.model == PENDULA:
        for norm in ("l2", "linf"):
            about = f"{NAMES[norm]}, of the angles"
            variables[norm] = variables[norm]._replace(long_name=about, units="rad")
    attributes = describe_run(name, problem, problem.solver)
    del attributes["half_width"]
    title = f"Norms of {name} against the half-width, by {problem.solver['name']}"
    return variables, {"title": title, **attributes, **count_work(sweep.outcomes)}


def describe_cases(problems: Mapping[str, Problem]) -> Contents:
    """Return names, detunings and initial data of several cases as variables, and attributes.

    The attributes hold each value that is the same in all cases, so that a dataset of many cases
    says what was solved, as a dataset of one case does. Other constants are variables too.
    """
    each = [describe_run(name, problem, problem.solver) for name, problem in problems.items()]
    variables = {
        "case": Variable(("case",), list(problems)),
        "omega": Variable(("case",), [float(one["omega"]) for one in each]),
        "initial": Variable(("case",), [one["initial"] for one in each]),
    }
    shared = shared_by(each, *variables)
    for name in [name for name in ("epsilon", "gamma") if name not in shared]:
        variables[name] = Variable(("case",), [float(one[name]) for one in each])
    return variables, shared


def constants_of(dataset, case: str) -> Constants:
    """Return the constants of one of the cases that `describe_cases` has described."""
    one = dataset.sel(case=case)
    own = {name: one[name] for name in ("epsilon", "gamma", "omega") if name in one}
    return Constants.of({**dataset.attrs, **own})


def side_by_side(arrays: Sequence[np.ndarray], axis: int) -> np.ndarray:
    """Return arrays on chains of any lengths as one array, with NaN beyond the ends of the shorter.

    `axis` is that of the sites, whose middle is site 0; the first axis of the result is new.
    """
    longest = max(one.shape[axis] for one in arrays)

    def padded(one: np.ndarray) -> np.ndarray:
        beyond = [(0, 0)] * one.ndim
        beyond[axis] = ((longest - one.shape[axis]) // 2,) * 2
        return np.pad(one, beyond, constant_values=np.nan)

    return np.stack([padded(one) for one in arrays])


def count_work(outcomes: list) -> dict[str, int]:
    """Return the work of one run, or of many, as attributes."""
    return {
        "steps": sum(outcome.steps for outcome in outcomes),
        "rejected_steps": sum(outcome.rejected for outcome in outcomes),
        "right_hand_sides": sum(outcome.evaluations for outcome in outcomes),
    }
