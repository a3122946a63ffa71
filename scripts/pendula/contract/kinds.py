"""Functions that load the arguments of a job, by the annotations of its function."""

from latticode.datasets.netcdf import read
from latticode.simulation import problem
from xarray import Dataset

from pendula.problem import PaperProblem

KINDS = {Dataset: read, PaperProblem: PaperProblem.of, problem.Problem: PaperProblem.of}
"""By type: a dataset is read from its path, and a problem is made from plain values.

The library's `Problem` is loaded by `PaperProblem` too, because plain values of the paper's
equations name their model."""
