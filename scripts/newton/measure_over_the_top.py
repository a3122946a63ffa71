"""Measure when pendula go over the top, and how far they turn then."""

from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.pendula import over_the_top


def measure_over_the_top(
    data: str,
    problem: dict,
    mus: list[float],
    per_period: int,
    size: float,
    members: int,
    seed: int,
    settled: float,
    kernels: list[str] | tuple = (),
) -> None:
    """Write first passages, chances by tau, and rates at each mu."""
    found = over_the_top.measure_over_the_top(
        Problem.of(problem), mus, per_period, size, members, seed, settled
    )
    write(data, *found)


if __name__ == "__main__":
    from job import run

    run(measure_over_the_top, snakemake)  # noqa: F821
