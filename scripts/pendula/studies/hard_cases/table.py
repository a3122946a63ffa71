"""The outcomes of the solvers on the hard cases as a table to read."""

import xarray as xr

from pendula.datasets.netcdf import read
from pendula.report.words import markdown, write_markdown


def tabulate_hard_cases(data: str, table: str) -> None:
    """Write the page of Markdown `table` on the dataset of the hard cases."""
    write_markdown(table, *page(read(data)))


def page(data: xr.Dataset) -> list[str]:
    """Return the parts of a page of Markdown on the dataset of the hard cases."""
    lines = []
    for index in range(data.sizes["row"]):
        row = {name: variable.values[index] for name, variable in data.items()}
        refusal = row["refusal"]
        outcome = f"rejected: {refusal}" if refusal else f"error {row['error']:.1e}"
        as_expected = "yes" if row["sound"] else "NO"
        lines.append((row["case"], row["solver"], outcome, row["reference"], as_expected))
    unsound = int((data["sound"] == 0).sum())
    words = (
        f"{len(lines)} runs, {unsound} with an outcome that is not the expected one. An error is "
        "that of the largest component over the largest, or of what the reference names."
    )
    head = ("case", "solver", "outcome", "reference", "as expected")
    return ["# Hard cases", words, markdown(head, lines)]
