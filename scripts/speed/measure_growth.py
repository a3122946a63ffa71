"""Measure how the cost of a run grows with the length of the chain and with time."""

from pendula.datasets import write
from pendula.speed import growth, machine


def measure_growth(problem: dict, data: str, kernels: list[str] | tuple = ()) -> None:
    """Write the measurements; `problem` (the arguments of simulate) is the case run for long."""
    write(data, growth.measure(problem), machine.describe())


if __name__ == "__main__":
    from job import run

    run(measure_growth, snakemake)  # noqa: F821
