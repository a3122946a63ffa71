"""What the workflow's own script writes of a case."""

from pendula.datasets.netcdf import read
from trajectories.simulate_case import simulate_case


def as_the_workflow_writes(case, name, path):
    """Return the dataset of a pendula.Case as a job of the workflow writes it to `path`."""
    simulate_case([str(path)], name, [case.shown_problem()])
    return read(path)
