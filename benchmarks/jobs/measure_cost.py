"""Measure how the cost of a run grows with the chain, with time and with the active sites."""

from pendula.datasets.netcdf import write
from pendula.problem import Problem

from benchmarks import machine
from benchmarks.cost import measure


def measure_cost(problem: dict, data: str, kernels: list[str] | tuple = ()) -> None:
    """Write the measurements; `problem` is the case that is run for long."""
    variables = measure(Problem.of(problem))
    write(data, variables, {"title": "How the cost of a run grows", **machine.describe()})


if __name__ == "__main__":
    from job import run

    run(measure_cost, snakemake)  # noqa: F821
