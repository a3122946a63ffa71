"""The rows of a run's ledger, and counts of them by verdict and origin."""

import re
from collections import Counter
from collections.abc import Iterable

from latticode.datasets.json_files import load_json

from replication.results import Results

from .claim import Origin
from .criterion import Verdict

LEDGER = "claims.json"


def load(results: Results) -> list[dict]:
    """Return the rows of the ledger of a run."""
    return load_json(results.path(LEDGER))["rows"]


def on_figure(rows: list[dict], figure: int) -> list[dict]:
    """Return the rows of the paper's claims on a figure, whose place may be "Figs 2 and 6"."""
    named = re.compile(rf"Figs? [\d, and]*{figure}")
    matching = (row for row in rows if named.search(row["place"]))
    return [row for row in matching if row["origin"] == Origin.PAPER]


def tally(rows: Iterable[dict]) -> dict[str, dict[str, int]]:
    """Return the number of rows by origin and verdict, without zeros."""
    counts = Counter((row["origin"], row["verdict"]) for row in rows)
    by_origin = {
        str(origin): {str(v): counts[origin, v] for v in Verdict if counts[origin, v]}
        for origin in Origin
    }
    return {origin: counted for origin, counted in by_origin.items() if counted}


def counted(rows: list[dict]) -> list[str]:
    """Return a line for each origin: the number of its claims, in total and by verdict."""
    return [
        f"{sum(verdicts.values())} claims {origin}: {_list_counts(verdicts)}"
        for origin, verdicts in tally(rows).items()
    ]


def counted_verdicts(rows: list[dict]) -> str:
    """Return how many rows have each verdict, such as "2 confirmed, 1 not reproduced"."""
    counts = Counter(row["verdict"] for row in rows)
    return (
        _list_counts({str(verdict): counts[verdict] for verdict in Verdict if counts[verdict]})
        or "none"
    )


def counted_origins(rows: list[dict]) -> str:
    """Return how many rows are of each origin, such as "2 of the paper, 1 of this project"."""
    counts = Counter(row["origin"] for row in rows)
    return ", ".join(f"{counts[origin]} {origin}" for origin in Origin if counts[origin])


def whether_it_holds(rows: list[dict]) -> str:
    """Return whether the paper's claims about a figure hold, as a phrase."""
    counts = Counter(row["verdict"] for row in rows)
    failing = len(rows) - counts[Verdict.CONFIRMED] - counts[Verdict.CAVEAT]
    if not rows:
        return "a drawing"
    if counts[Verdict.NOT_APPLICABLE]:
        return "not applicable"
    if failing == len(rows):
        return "does not hold"
    if failing:
        return f"holds, except for {failing} of the claims"
    return "holds with a caveat" if counts[Verdict.CAVEAT] else "holds"


def _list_counts(counts: dict[str, int]) -> str:
    return ", ".join(
        f"{n} {verdict if n == 1 else verdict.replace('does not', 'do not')}"
        for verdict, n in counts.items()
    )
