"""Write the outcomes of the hard cases as a table to read."""

from pendula.datasets.netcdf import read
from pendula.report.tables import write_page
from pendula.studies.hard_cases.section import page


def tabulate_hard_cases(data: str, table: str) -> None:
    """Write the page of Markdown `table` on the dataset of the hard cases."""
    write_page(table, *page(read(data)))


if __name__ == "__main__":
    from job import run

    run(tabulate_hard_cases, snakemake)  # noqa: F821
