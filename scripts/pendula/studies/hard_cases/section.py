"""The hard cases in the report and as a table: errors, or rejections with their reasons."""

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import read
from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section, Table
from pendula.report.words import markdown, number, symbols, write_markdown

SOURCE = "checks/hard_cases"


def gather(results: Results, ledger: Ledger) -> dict[str, Table]:
    """Return the outcomes by solver, and every run."""
    data = results[SOURCE]
    names = np.array([str(solver).partition(":")[0] for solver in data["solver"].values])
    of_solver = {SOLVER_NAMES.get(name, name): names == name for name in dict.fromkeys(names)}
    everything = {"all": np.ones(len(names), dtype=bool)}
    return {
        "by_solver": Table(
            f"Thresholds, tiny and huge initial conditions, long times and impossible tolerances: "
            f"{len(set(data['case'].values))} cases",
            ["solver", "runs", "rejected with a reason", "largest error / allowed error",
             "not as required"],
            [_outcomes(results, name, own) for name, own in (of_solver | everything).items()],
        ),
        "runs": Table(
            "Every run", ["case", "solver", "outcome", "reference", "as required"],
            [_row(results, row) for row in range(data.sizes["row"])], folded=True,
        ),
    }  # fmt: skip


def _outcomes(results: Results, name: str, own: np.ndarray) -> list:
    """Return a row of the table on the runs that the mask `own` selects."""
    data = results[SOURCE].isel(row=np.flatnonzero(own))
    rejected = data["refusal"].values != ""
    share = (data["error"] / data["limit"]).values
    ended = share[~rejected & np.isfinite(share)]
    return [
        name,
        results.quote(SOURCE, data.sizes["row"], 6),
        results.quote(SOURCE, int(rejected.sum()), 6),
        results.quote(SOURCE, ended.max() if ended.size else np.nan, 2),
        results.quote(SOURCE, int((data["sound"] == 0).sum()), 6),
    ]


def _row(results: Results, index: int) -> list:
    row = results[SOURCE].isel(row=index)
    refusal = str(row["refusal"].values)
    outcome = f"rejected: {refusal}" if refusal else f"error {number(float(row['error']), 2)}"
    texts = [str(row["case"].values), str(row["solver"].values), outcome,
             str(row["reference"].values)]  # fmt: skip
    return [*map(symbols, texts), "yes" if int(row["sound"]) else "no"]


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


SECTIONS = (Section("hard_cases", "Hard cases", gather),)
