"""Variables and attributes that describe the cases in a dataset of many."""

from collections.abc import Mapping

from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run, shared_by
from latticode.datasets.trajectories import Contents
from replication.variables import REGULAR

from pendula import names  # noqa: F401, adds the paper's long names
from pendula.problem import PaperProblem

COMPONENTS = Variable(("component",), ["A", "B"])


def describe_cases(problems: Mapping[str, PaperProblem]) -> Contents:
    """Return variables and attributes that describe several cases.

    The variables are names, detunings, initial data, and the constants in which the cases differ.
    The attributes are the values that all cases share, named as in the dataset of a single case.
    """
    each = [describe_run(name, problem, problem.solver) for name, problem in problems.items()]
    variables = {
        "case": Variable(("case",), list(problems)),
        "omega": Variable(
            ("case",), [float(description["omega"]) for description in each], attributes=REGULAR
        ),
        "initial": Variable(("case",), [description["initial"] for description in each]),
    }
    shared = shared_by(each, *variables)
    for name in [name for name in ("epsilon", "gamma") if name not in shared]:
        variables[name] = Variable(
            ("case",), [float(description[name]) for description in each], attributes=REGULAR
        )
    return variables, shared
