"""Write the measurements of speed as tables, from their datasets."""

from pendula.datasets.netcdf import read
from pendula.report.words import write_markdown

from benchmarks.tables import tabulate_cost, tabulate_work_precision


def tabulate_speed(
    work_precision: str, cost: str, work_precision_table: str, cost_table: str
) -> None:
    """Write both pages of Markdown."""
    write_markdown(work_precision_table, *tabulate_work_precision(read(work_precision)))
    write_markdown(cost_table, *tabulate_cost(read(cost)))


if __name__ == "__main__":
    from job import run

    run(tabulate_speed, snakemake)  # noqa: F821
