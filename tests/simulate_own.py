"""What a job of the workflow writes of a case."""

from latticode.datasets.netcdf import read, write
from pendula.problem import Problem
from pendula.studies.paper.runs import run_case


def as_the_workflow_writes(case, name, path):
    """Return the dataset of a pendula.Case as a job of the workflow writes it to `path`."""
    write(path, *run_case(name, Problem.of(case.shown_problem())))
    return read(path)
