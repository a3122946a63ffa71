"""Runs on chains without ends as datasets."""

import numpy as np

from pendula import __version__
from pendula.datasets.netcdf import Variable
from pendula.problem import Problem, write_initial

from .linear_front import linear_front
from .spread import LEVELS, Spread
from .window_map import START, WindowMap

RUN = ("variant", "member")


def spread_variables(problems: list[Problem], runs: list[list[Spread]]) -> dict[str, Variable]:
    """Return the variables of `runs` [variant][member] of as many problems."""
    first = runs[0][0]
    predicted = [linear_front(problem.constants) for problem in problems]

    def series(name: str, axis: str, title: str, more: tuple = ()) -> Variable:
        values = [[getattr(run, name) for run in members] for members in runs]
        return Variable((*RUN, axis, *more), np.array(values), title)

    return {
        "tau": Variable(("tau",), first.tau, "slow time"),
        "piece_tau": Variable(("piece_tau",), first.piece_tau, "slow time at the end of a piece"),
        "level": Variable(("level",), LEVELS, "power |A|^2 + |B|^2 at which the front is found"),
        **_parameters(problems),
        "l2": series("l2", "tau", "l2 norm of (A, B) over the chain"),
        "linf": series("linf", "tau", "l-infinity norm of (A, B) over the chain"),
        "energy": series("energy", "tau", "conserved energy H of equation (8)"),
        "front": series("front", "piece_tau", "outermost site above a power", ("level",)),
        "width": series("width", "piece_tau", "last site of the window, W"),
        "evaluations": series("evaluations", "piece_tau", "right-hand sides taken in the piece"),
        "state": Variable(
            (*RUN, "row", "site"),
            _padded([[run.state[:, 1:-1] for run in members] for members in runs]),
            "Re A, Im A, Re B, Im B at the end, zero beyond the window",
        ),
        "predicted_speed": _of_variants(
            [front.speed for front in predicted], "linear spreading speed (sites per tau)"
        ),
        "predicted_delay": _of_variants(
            [front.delay for front in predicted], "sites lost per unit of log tau on the way to it"
        ),
    }


def map_variables(
    maps: list[WindowMap], half_widths: list[int], ends: np.ndarray, speed: float
) -> dict[str, Variable]:
    """Return the variables of the maps of an ensemble's members."""
    axes = ("member", "half_width", "end")
    window = f"maximum over [{START:g}, end]"
    return {
        "half_width": Variable(
            ("half_width",), np.asarray(half_widths), "half-width M of the chain of 2M + 1 pairs"
        ),
        "end": Variable(("end",), ends, "end of the window of slow time"),
        "l2": Variable(axes, [m.l2 for m in maps], f"l2 norm of (A, B), {window}"),
        "linf": Variable(axes, [m.linf for m in maps], f"l-infinity norm of (A, B), {window}"),
        "arrival": Variable(
            axes[:2], [m.arrival for m in maps], "slow time at which the window reached the end"
        ),
        "predicted_speed": Variable((), speed, "linear spreading speed (sites per tau)"),
    }


def attributes(name: str, problem: Problem, rest: float) -> dict:
    """Return what was solved: no dates, no hosts."""
    values = problem.plain()
    plain = {key: values[key] for key in ("epsilon", "gamma", "omega", "end_time", "output_step")}
    return {
        "case": name,
        **plain,
        "rest": rest,
        "initial": write_initial(values["initial"]),
        "boundary": "none: the window opens as the front moves",
        "solver": problem.solver["name"],
        "solver_rtol": problem.solver["rtol"],
        "version": __version__,
    }


def _parameters(problems: list[Problem]) -> dict[str, Variable]:
    return {
        "omega": _of_variants([p.constants.omega for p in problems], "detuning Omega"),
        "amplitude": _of_variants([_central(p) for p in problems], "initial |A_0|"),
        "tolerance": _of_variants([p.solver["rtol"] for p in problems], "solver's tolerance"),
    }


def _central(problem: Problem) -> float:
    """Return |A_0| at the start."""
    return abs(problem.initial[0, problem.initial.shape[1] // 2])


def _of_variants(values: list[float], title: str) -> Variable:
    return Variable(("variant",), np.array(values, float), title)


def _padded(states: list[list[np.ndarray]]) -> np.ndarray:
    widest = max(state.shape[1] for members in states for state in members)
    return np.array(
        [[np.pad(s, ((0, 0), (0, widest - s.shape[1]))) for s in members] for members in states]
    )
