"""The hard cases: digits with their error, or a refusal in words."""

from collections import Counter
from typing import Any

import numpy as np

from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section
from pendula.report.words import number, symbols

SOURCE = "checks/hard_cases"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the outcomes by solver, and every row."""
    data = results[SOURCE]
    names = [str(solver).partition(":")[0] for solver in data["solver"].values]
    refused = data["refusal"].values != ""
    unsound = data["sound"].values == 0
    return {
        "runs": results.quote(SOURCE, data.sizes["row"], 6),
        "cases": results.quote(SOURCE, len(set(data["case"].values)), 6),
        "refused": results.quote(SOURCE, int(refused.sum()), 6),
        "unexpected": results.quote(SOURCE, int(unsound.sum()), 6),
        "sound": not unsound.any(),
        "by_solver": _by_solver(results, names, refused, unsound),
        "rows": [_row(results, row) for row in range(data.sizes["row"])],
    }


def _by_solver(results: Results, names: list[str], refused, unsound) -> list[list]:
    data = results[SOURCE]
    share = (data["error"] / data["limit"]).values
    rows = []
    for solver in Counter(names):
        own = np.array(names) == solver
        ended = share[own & ~refused & np.isfinite(share)]
        rows.append(
            [
                SOLVER_NAMES.get(solver, solver),
                results.quote(SOURCE, own.sum(), 6),
                results.quote(SOURCE, (own & refused).sum(), 6),
                results.quote(SOURCE, ended.max() if ended.size else np.nan, 2),
                results.quote(SOURCE, (own & unsound).sum(), 6),
            ]
        )
    return rows


def _row(results: Results, index: int) -> list:
    row = results[SOURCE].isel(row=index)
    refusal = str(row["refusal"].values)
    said = f"refused: {refusal}" if refusal else f"error {number(float(row['error']), 2)}"
    cells = (str(row[name].values) for name in ("case", "solver"))
    return [*map(symbols, cells), symbols(said), symbols(str(row["reference"].values)),
            "yes" if int(row["sound"]) else "no"]  # fmt: skip


SECTIONS = (Section("hard_cases", "Hard cases", gather),)
