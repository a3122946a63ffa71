"""Measure how the cost of a run grows with the chain and with time."""

from pendula.datasets.files import complete_or_absent
from pendula.datasets.netcdf import read, write
from pendula.speed import growth, machine
from pendula.speed.growth_table import write_table


def measure_growth(problem: dict, data: str, table: str, kernels: list[str] | tuple = ()) -> None:
    """Write the measurements; `problem` (the arguments of simulate) is the case run for long."""
    write(data, growth.measure(problem), machine.describe())
    with complete_or_absent(table) as partial:
        partial.write_text(write_table(read(data)), encoding="utf-8")


if __name__ == "__main__":
    from job import run

    run(measure_growth, snakemake)  # noqa: F821
