"""Write the outcomes of the hard cases as a table to read."""

import xarray

from pendula.datasets.netcdf import read
from pendula.report.words import markdown, write_markdown


def tabulate_hard_cases(data: str, table: str) -> None:
    """Write the page of Markdown `table` on the dataset of the hard cases."""
    write_markdown(table, *page(read(data)))


def page(data: xarray.Dataset) -> list[str]:
    """Return the parts of a page of Markdown on the dataset of the hard cases."""
    rows = [data.isel(row=index) for index in range(data.sizes["row"])]
    unsound = int((data["sound"] == 0).sum())
    words = (
        f"{len(rows)} runs, {unsound} with an outcome that is not the expected one. An error is "
        "that of the largest component over the largest, or of what the reference names."
    )
    head = ("case", "solver", "outcome", "reference", "as expected")
    return ["# Hard cases", words, markdown(head, map(cells, rows))]


def cells(row: xarray.Dataset) -> tuple[str, ...]:
    """Return one row of the table."""
    case, solver, refusal, reference = (
        str(row[name].values) for name in ("case", "solver", "refusal", "reference")
    )
    said = f"refused: {refusal}" if refusal else f"error {float(row['error']):.1e}"
    return case, solver, said, reference, "yes" if int(row["sound"]) else "NO"
