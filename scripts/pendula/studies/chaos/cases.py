"""What the datasets of chaos say of their cases."""

from pendula.datasets.netcdf import Variable
from pendula.problem import write_initial


def describe_cases(problems: dict[str, dict]) -> dict[str, Variable]:
    """Return names, detunings and initial data of `problems`, the arguments of `simulate`."""
    omegas = [float(problem["omega"]) for problem in problems.values()]
    initials = [write_initial(problem["initial"]) for problem in problems.values()]
    return {
        "case": Variable(("case",), list(problems), "case"),
        "omega": Variable(("case",), omegas, "detuning Omega"),
        "initial": Variable(("case",), initials, "initial {site: [A, B]}"),
    }
