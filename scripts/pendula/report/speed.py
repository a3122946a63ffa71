"""Speed against error, read from the table that the speed rules write."""

from pathlib import Path
from typing import Any, NamedTuple

from .numbers import number
from .pictures import picture
from .results import ReportError, Results
from .words import SOLVERS, case_of, symbols

TARGETS = {
    **dict.fromkeys(("fig2_small", "fig3_small"), 1e-10),
    **dict.fromkeys(("fig2_large", "fig3_large", "fig4_small", "fig4_large"), 1e-6),
}
"""The error at which solvers are compared on each case."""


class Measured(NamedTuple):
    """Where the measurements are, as links of the page; `fresh` if this machine made them."""

    table: str
    pictures: list[str]
    fresh: bool


def gather(results: Results, measured: Measured) -> dict[str, Any]:
    """Return the peers' times over ours and our solvers' own times at the error asked for."""
    tables = read(results.path(measured.table))
    _, *peers = next(rows for title, rows in tables.items() if "peers" in title)
    ours = {case: tables[case] for case in TARGETS if case in tables}
    times = {case: best_times(rows, TARGETS[case]) for case, rows in ours.items()}
    solvers = list(dict.fromkeys(name for found in times.values() for name in found))
    wins = [min(found, key=found.get) for found in times.values() if found]
    fastest = max(dict.fromkeys(wins), key=wins.count)
    return {
        "fresh": measured.fresh,
        "peers": [
            [row[0], results.say(measured.table, symbols(row[-1]))]
            for row in peers
            if row[-1] != "-"
        ],
        "absent": [row[0] for row in peers if row[-1] == "-"],
        "head": ["case", "error", *(SOLVERS[name] for name in solvers)],
        "rows": [_row(results, measured.table, case, times[case], solvers) for case in times],
        "fastest": SOLVERS[fastest],
        "wins": results.quote(measured.table, wins.count(fastest)),
        "cases": results.quote(measured.table, len(times)),
        "pictures": [
            picture(results.path(link), _alt(times, solvers), link) for link in measured.pictures
        ],
        "table": measured.table,
    }


def read(path: Path) -> dict[str, list[list[str]]]:
    """Return the tables of a Markdown file by the headings above them, each row split in cells."""
    tables, title = {}, ""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            title = line.lstrip("# ")
        elif line.startswith("|") and set(line) - set("|- "):
            tables.setdefault(title, []).append([cell.strip() for cell in line[1:-1].split("|")])
    if not any("peers" in title for title in tables) and not set(tables) & set(TARGETS):
        raise ReportError(f"{path} holds no table of speed: run `snakemake speed`")
    return tables


def best_times(rows: list[list[str]], target: float) -> dict[str, float]:
    """Return the least time in ms in which each solver comes within an error."""
    head, *body = rows
    solver, time, error = (head.index(name) for name in ("solver", "time, ms", "error"))
    best = {}
    for row in body:
        if float(row[error]) <= target:
            best[row[solver]] = min(float(row[time]), best.get(row[solver], float("inf")))
    return best


def _row(results: Results, table: str, case: str, times: dict, solvers: list[str]) -> list:
    cells = [results.quote(table, times[s]) if s in times else "not reached" for s in solvers]
    known = results["checks/cases"].sel(case=case)
    return [case_of(known), number(TARGETS[case]), *cells]


def _alt(times: dict[str, dict], solvers: list[str]) -> str:
    told = "; ".join(
        f"{SOLVERS[name]} {number(min(found[name] for found in times.values() if name in found))}"
        for name in solvers
    )
    return f"Time against error, a line a solver. Least times in ms at the error asked for: {told}."
