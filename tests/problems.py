"""Problems for tests: the paper's cases, or others with given constants and initial data."""

from latticode.datasets.netcdf import read, write
from oracle import CASES, SOLVERS
from pendula.problem import Constants, PaperProblem
from pendula.studies.paper.runs import run_case

UNIT = {"epsilon": 1.0, "gamma": 1.0}
PAPER = (1.0, 1.0, -4.0)
"""epsilon, gamma and Omega of Fig 3."""


def problem_of(case: str = "fig4_small", **changes) -> PaperProblem:
    """Return a case of the paper; `changes` are plain values, such as half_width or initial."""
    omega, pair = CASES[case]
    settings = UNIT | {
        "omega": omega,
        "half_width": 30,
        "boundary": "dirichlet",
        "initial": {0: pair},
        "end_time": 1.0,
        "output_step": 0.025,
        "solver": {"name": "dop853", "rtol": 1e-12, "atol": 1e-12},
    }
    return PaperProblem.of(settings | changes)


def constants_of(values=PAPER) -> Constants:
    """Return the constants with the values (epsilon, gamma, Omega)."""
    epsilon, gamma, omega = map(float, values)
    return Constants(epsilon=epsilon, gamma=gamma, omega=omega)


def problem_from(amplitudes, values, boundary="dirichlet", **changes) -> PaperProblem:
    """Return the problem of a whole chain with these amplitudes (2, 2M + 1) and constants."""
    base = problem_of(half_width=amplitudes.shape[1] // 2, boundary=boundary, **changes)
    return base.changed(constants=constants_of(values), initial=amplitudes)


def make_problem(initial, numbers=PAPER, boundary="dirichlet", solver="dop853", **changes):
    """Return the problem of a chain with the initial data (2, 2M + 1) up to tau = 1."""
    values = {
        "parameters": vars(constants_of(numbers)),
        "half_width": initial.shape[1] // 2,
        "end_time": 1.0,
        "output_step": 0.25,
        "solver": SOLVERS[solver] if isinstance(solver, str) else solver,
    }
    return PaperProblem(boundary=boundary, initial=initial, **values).changed(**changes)


def as_the_workflow_writes(case, name, path):
    """Return the dataset of a pendula.Case after a job of the workflow wrote it to `path`."""
    write(path, *run_case(name, PaperProblem.of(case.shown_problem())))
    return read(path)
