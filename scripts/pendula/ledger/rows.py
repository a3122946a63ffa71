"""The rows of a run's ledger, counts of them, and the numbers that others quote from them."""

import re
from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING

from latticode.datasets.json_files import load_json

from .claim import Origin
from .criterion import Verdict

if TYPE_CHECKING:
    from pendula.report.results import Results
    from pendula.report.words import Quote

LEDGER = "claims.json"


def load(results: "Results") -> list[dict]:
    """Return the rows of the ledger of a run."""
    return load_json(results.path(LEDGER))["rows"]


def on_figure(rows: list[dict], figure: int) -> list[dict]:
    """Return the rows of the paper's claims on a figure, whose place may be "Figs 2 and 6"."""
    named = re.compile(rf"Figs? [\d, and]*{figure}")
    found = (row for row in rows if named.search(row["place"]))
    return [row for row in found if row["origin"] == Origin.PAPER]


def tally(rows: Iterable[dict]) -> dict[str, dict[str, int]]:
    """Return by origin how many rows have each verdict; what no row has is left out."""
    counts = Counter((row["origin"], row["verdict"]) for row in rows)
    by_origin = {
        str(origin): {str(v): counts[origin, v] for v in Verdict if counts[origin, v]}
        for origin in Origin
    }
    return {origin: counted for origin, counted in by_origin.items() if counted}


def counted(rows: list[dict]) -> list[str]:
    """Return a line for each origin of claims: how many there are, and with which verdicts."""
    return [
        f"{sum(verdicts.values())} claims {origin}: "
        + ", ".join(f"{n} {one.replace('does not', 'do not')}" for one, n in verdicts.items())
        for origin, verdicts in tally(rows).items()
    ]


class Ledger:
    """The numbers of the ledger by claim, each linked to a dataset that decides the claim."""

    def __init__(self, results: "Results"):
        self._results = results
        self.rows = load(results)
        self._by_name = {row["name"]: row for row in self.rows}

    def value(self, claim: str, key: str) -> float:
        """Return a measured number, NaN if the claim was not decided or is not applicable."""
        measured = self._by_name[claim]["measured"].get(key, "nan")
        return float({"none": "nan", "infinite": "inf"}.get(measured, measured))

    def quote(self, claim: str, key: str, digits: int = 3) -> "Quote":
        """Return a measured number as a page shows it."""
        source = self._by_name[claim]["decided_by"][0]
        return self._results.quote(source, self.value(claim, key), digits)
