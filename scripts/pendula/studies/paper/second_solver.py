"""The paper's second solver in both readings, and at several steps: what its silence leaves open.

The paper names neither the scheme exactly nor its step. Here each scheme runs at the configured
step, at twice and at half of it, and is held to the paper's first solver.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.measures.difference import VISIBLE, first_above, norm_difference
from pendula.measures.norms import drift
from pendula.problem import Problem, name_window
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import Trajectory, simulate
from pendula.simulation.sweep import QUANTITIES, STATISTICS, sweep

SCHEMES = ("crank_nicolson", "implicit_midpoint", "delfour_fortin_payre")
FACTORS = (2.0, 1.0, 0.5)
"""Steps in units of the configured one, each half of the one before."""
FINER = (1.0, 0.25)
"""The same for a chaotic sweep, where runs by all steps differ: there ensembles are compared."""
DRAWS = 10
"""Members of these ensembles, which tell means apart that differ by a tenth."""
GRID = ("case", "scheme", "step")
RICHARDSON = 4.0 / 3.0
"""A method of second order is off by so many times its difference from half the step."""


def measure(
    problems: Mapping[str, Problem],
    firsts: Mapping,
    swept_problem: Problem,
    half_widths: Sequence[int],
    windows: Sequence[tuple[float, float]],
    ensemble: Mapping[str, float],
) -> Contents:
    """Return how far the schemes are from the runs `firsts` of the first solver, in one order.

    `problems` are those of the cases by the second solver, at the configured step. `swept_problem`
    is that of a chaotic sweep, of which an ensemble is run at each of the FINER steps, on some of
    its half-widths; `ensemble` says the size of the changes and the seed.
    """
    pairs = zip(problems.values(), firsts.values(), strict=True)
    found = [_measure_case(problem, first) for problem, first in pairs]
    described, shared = describe_cases(problems)
    step = next(iter(problems.values())).solver["step"]
    about = {
        "scheme_difference": (GRID, "largest difference of the norms from the first solver's"),
        "scheme_divergence": (GRID, f"first tau of a difference of {VISIBLE:.0%} of full scale"),
        "scheme_drift": (GRID, "largest drift of the energy"),
        "step_error": (GRID[:2], "error of the norms by the step, estimated from half the step"),
        "readings_difference": (
            ("case", "step"),
            "largest difference of the norms by the trapezoidal and the midpoint rule",
        ),
    }
    variables = {
        **described,
        "scheme": Variable(("scheme",), list(SCHEMES), "scheme of the second solver"),
        "step": Variable(("step",), [step * factor for factor in FACTORS], "step of the scheme"),
    }
    for name, (grid, long_name) in about.items():
        variables[name] = Variable(grid, np.array([one[name] for one in found]), long_name)
    variables |= _finer(swept_problem, half_widths, windows, **ensemble)
    attributes = {key: value for key, value in shared.items() if not key.startswith("solver")}
    title = "The second solver by both readings and by the scheme that conserves the energy"
    return variables, {"title": title, **attributes, "configured_step": step}


def _finer(problem: Problem, half_widths, windows, size: float, seed: int) -> dict[str, Variable]:
    """Return the norms of draws of a sweep by the first scheme at FINER steps.

    The first draw has the data themselves. Each half-width has draws of its own, and other ones
    than the first solver, so that all means are independent of each other.
    """
    steps = [problem.solver["step"] * factor for factor in FINER]
    found = []
    for step in steps:
        own = problem.changed(solver={**problem.solver, "step": step})
        for width in half_widths:
            draws = [own, *draw_members(own, size, DRAWS - 1, [seed, width, 1])]
            runs = [sweep(one, [width], windows) for one in draws]
            found.append([(run.l2[0], run.linf[0]) for run in runs])
    by_width = np.array(found).reshape(len(steps), len(half_widths), *np.shape(found)[1:])
    norms = np.moveaxis(by_width, 3, 0).swapaxes(2, 3)
    grid = ("finer_step", "draw", "half_width", "quantity", "statistic", "window")
    names = [name_window(window) for window in windows]
    axes = (list(half_widths), list(QUANTITIES), list(STATISTICS), names)
    return {
        "finer_step": Variable(grid[:1], steps, "step of the second solver in a chaotic sweep"),
        "draw": Variable(("draw",), np.arange(DRAWS), "draw, the first from the data themselves"),
        **{name: Variable((name,), axis) for name, axis in zip(grid[2:], axes, strict=True)},
        "l2": Variable(grid, norms[0]),
        "linf": Variable(grid, norms[1]),
    }


def _measure_case(problem: Problem, first) -> dict[str, np.ndarray]:
    def run(scheme: str, factor: float) -> Trajectory:
        controls = {**problem.solver, "name": scheme, "step": factor * problem.solver["step"]}
        return simulate(problem.changed(solver=controls, snapshot_every=0))

    runs = [[run(scheme, factor) for factor in FACTORS] for scheme in SCHEMES]
    apart = np.array([[_difference(run, first) for run in row] for row in runs])
    halved = [_difference(*row[1:]).max() for row in runs]
    readings = [_difference(one, other).max() for one, other in zip(*runs[:2], strict=True)]
    return {
        "scheme_difference": apart.max(axis=-1),
        "scheme_divergence": first_above(problem.times, apart, VISIBLE),
        "scheme_drift": np.array([[drift(run.energy).max() for run in row] for row in runs]),
        "step_error": RICHARDSON * np.array(halved),
        "readings_difference": np.array(readings),
    }


def _difference(run, other) -> np.ndarray:
    return norm_difference(run.linf, run.l2, *(np.asarray(one) for one in (other.linf, other.l2)))
