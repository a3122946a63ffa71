"""The functions of the jobs of `snakemake speed`."""

from collections.abc import Mapping
from functools import partial

import xarray as xr
from latticode.datasets.trajectories import Contents
from latticode.kernels.sources import describe_machine
from pendula.problem import PaperProblem
from replication.words import number

from benchmarks import cost, pendula
from benchmarks.contestants import PEERS, find_peers
from benchmarks.peers_in_python import OF_PENDULA
from benchmarks.problems import REGIME_OF, REGIMES, read_reference, until
from benchmarks.work_precision import measure as measure_errors

report = partial(print, flush=True)


def measure_work_precision(
    references: Mapping[str, xr.Dataset], problems: Mapping[str, PaperProblem]
) -> Contents:
    """Return the dataset of times and errors of all solvers and installed peers on `problems`."""
    cases, exact = {}, {}
    for name, problem in problems.items():
        horizon = REGIMES[REGIME_OF[name]].horizon
        cases[name] = until(problem, horizon)
        exact[name] = read_reference(references[name], horizon)
    peers, absent = find_peers(PEERS)
    variables = measure_errors(cases, exact, peers, report)
    return variables, {"title": "Speed against error", "absent": absent, **describe_machine()}


def measure_pendula(problems: Mapping[str, PaperProblem]) -> Contents:
    """Return the dataset of times and errors for Newton's equations in the cases of `problems`."""
    peers, absent = find_peers(OF_PENDULA)
    variables = pendula.measure(problems, peers, report)
    title = {"title": "Speed against error on the pendula", "absent": absent}
    return variables, {**title, "compared_at": number(pendula.TARGET), **describe_machine()}


def measure_cost() -> Contents:
    """Return the dataset of times against the length of the chain."""
    attrs = {"title": "How the cost of a run grows", "end_of_peers": cost.PEERS_END}
    return cost.measure(), {**attrs, **describe_machine()}
