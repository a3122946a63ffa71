"""Measure until when each solver's norms are those of the multiprecision references."""

from itertools import product

from pendula.datasets.netcdf import read, save
from pendula.studies.paper.solvers import trust


def measure_trust(
    trajectories: list[str],
    references: list[str],
    decimal: list[str],
    proved: list[str],
    cases: list[str],
    solvers: list[str],
    certified: list[str],
    data: str,
) -> None:
    """Write the dataset; `trajectories` run over cases, then over solvers.

    `decimal` holds the references from data as printed, and from the doubles next to them, and
    `proved` the curves of the cases `certified`, each with its bound.
    """
    runs = dict(zip(product(cases, solvers), map(read, trajectories), strict=True))
    known = dict(zip(cases, map(read, references), strict=True))
    curves = dict(zip(certified, map(read, proved), strict=True))
    save(data, trust(runs, known, tuple(map(read, decimal)), curves))


if __name__ == "__main__":
    from job import run

    run(measure_trust, snakemake)  # noqa: F821
