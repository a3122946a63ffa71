"""Measure the paper's solvers: drift of the energy, and agreement of trajectories and sweeps."""

from itertools import product

from pendula.datasets.netcdf import read, save
from pendula.studies.paper.solvers import compare


def measure_solvers(
    trajectories: list[str],
    first: list[str],
    second: list[str],
    cases: list[str],
    solvers: list[str],
    sweeps: list[str],
    others: list[str],
    data: str,
) -> None:
    """Write the dataset; `trajectories` run over cases, then over solvers.

    `first` and `second` are the sweeps by the one solver of the paper and by the other. `others`
    are the cases that the configuration has changed: the paper states nothing about them.
    """
    runs = dict(zip(product(cases, solvers), map(read, trajectories), strict=True))
    pairs = zip(map(read, first), map(read, second), strict=True)
    save(data, compare(runs, dict(zip(sweeps, pairs, strict=True)), others))


if __name__ == "__main__":
    from job import run

    run(measure_solvers, snakemake)  # noqa: F821
