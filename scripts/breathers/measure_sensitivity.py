"""Measure which of almost equal data spread over the chain."""

import numpy as np
from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.breathers.contents import sensitivity_contents


def measure_sensitivity(
    data: str,
    name: str,
    problem: dict,
    sizes: list[float],
    members: int,
    seed: int,
    amplitudes: list[float],
    kernels: list[str] | tuple = (),
) -> None:
    """Write the share that spreads for each size of a change, and a scan of `amplitudes`."""
    given = Problem.of(problem)
    write(data, *sensitivity_contents(name, given, sizes, members, seed, np.array(amplitudes)))


if __name__ == "__main__":
    from job import run

    run(measure_sensitivity, snakemake)  # noqa: F821
