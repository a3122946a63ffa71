"""What the datasets of chaos say of their cases."""

from pendula.datasets.netcdf import Variable
from pendula.problem import Problem, by_site, write_initial


def describe_cases(problems: dict[str, Problem]) -> dict[str, Variable]:
    """Return names, detunings and initial data of `problems` by case."""
    omegas = [float(problem.constants.omega) for problem in problems.values()]
    initials = [write_initial(by_site(problem.initial)) for problem in problems.values()]
    return {
        "case": Variable(("case",), list(problems), "case"),
        "omega": Variable(("case",), omegas, "detuning Omega"),
        "initial": Variable(("case",), initials, "initial {site: [A, B]}"),
    }
