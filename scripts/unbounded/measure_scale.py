"""Measure what a site costs on windows of up to a million sites."""

from pathlib import Path

from pendula.datasets.files import complete_or_absent
from pendula.datasets.netcdf import write
from pendula.speed import machine
from pendula.studies.unbounded import scale


def measure_scale(data: str, table: str, kernels: list[str] | tuple = ()) -> None:
    """Write the measurements as a dataset and as a table."""
    measured = scale.measure()
    write(data, measured, machine.describe())
    with complete_or_absent(table) as partial:
        Path(partial).write_text(f"{scale.tabulate(measured)}\n", encoding="utf-8")
    print(scale.tabulate(measured))


if __name__ == "__main__":
    from job import run

    run(measure_scale, snakemake)  # noqa: F821
