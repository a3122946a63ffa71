"""Run the hard cases: a dataset of what each solver made of them, and a table to read."""

from pendula.datasets.netcdf import write
from pendula.report.tables import write_page
from pendula.studies.hard_cases.table import outcomes, page, variables


def run_hard_cases(data: str, table: str, kernels: list[str] | tuple = ()) -> None:
    """Write both; a row that does not end as expected is said here and marked in the table."""
    results = outcomes()
    write(data, variables(results), {"title": "Hard cases for the solvers"})
    write_page(table, page(results))
    for result in results:
        if not result.sound:
            print(f"NOT AS EXPECTED: {result.case}, {result.solver}: {result.error:.3g} ")


if __name__ == "__main__":
    from job import run

    run(run_hard_cases, snakemake)  # noqa: F821
