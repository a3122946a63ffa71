"""What makes the arguments of a function that computes, by the annotations of its parameters."""

from latticode.datasets.netcdf import read
from latticode.simulation import problem
from xarray import Dataset

from pendula.problem import PaperProblem

KINDS = {Dataset: read, PaperProblem: PaperProblem.of, problem.Problem: PaperProblem.of}
"""By type: a dataset is read from its path, and a problem is made of plain values.

Rules give problems of the paper's equations or of a user's model, so that the paper's class makes
them of the library's annotation too."""
