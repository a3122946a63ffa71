"""The ledger of claims: every row with its verdict, and how many there are of each."""

from typing import Any

from pendula.datasets.json_files import load_json
from pendula.report.results import Results
from pendula.report.words import Quote, number, plainly, symbols

from .claim import Origin, controls_of, cutoff_lines
from .criterion import Verdict
from .tables import tally

LEDGER = "claims.json"


def load(results: Results) -> list[dict]:
    """Return the rows of the ledger."""
    return load_json(results.path(LEDGER))["rows"]


def gather(results: Results) -> dict[str, Any]:
    """Return the rows as the page shows them, and the counts of verdicts by origin."""
    rows = load(results)
    fed = controls_of(rows)
    inapplicable = sum(row["verdict"] == Verdict.NOT_APPLICABLE for row in rows)
    return {
        "rows": [_shown(row, results) for row in rows],
        "total": results.say(LEDGER, str(len(rows))),
        "counts": [
            (
                origin,
                results.say(LEDGER, str(sum(counts.values()))),
                [(verdict, results.say(LEDGER, str(n))) for verdict, n in counts.items()],
            )
            for origin, counts in tally(rows).items()
        ],
        "verdicts": [str(v) for v in Verdict if any(row["verdict"] == v for row in rows)],
        "resting": results.say(LEDGER, str(sum(bool(row["rests_on"]) for row in rows))),
        "controls": results.say(LEDGER, str(len(fed))),
        "failing": results.say(LEDGER, str(sum(one["passes"] is False for one in fed))),
        "unasked": results.say(LEDGER, str(sum(one["passes"] is None for one in fed))),
        "inapplicable": results.say(LEDGER, str(inapplicable)),
        "cutoffs": [[plainly_said(cell) for cell in line] for line in cutoff_lines(rows)],
        "fed": [[plainly_said(one[key]) for key in FED] for one in fed],
    }


FED = ("claim", "fed", "must", "verdict", "because")


def plainly_said(cell: float | str) -> str:
    """Return a cell of a table as the page shows it."""
    return symbols(cell) if isinstance(cell, str) else number(cell)


def _shown(row: dict, results: Results) -> dict:
    measured = ", ".join(f"{plainly(key)} = {_value(v)}" for key, v in row["measured"].items())
    return {
        "name": row["name"],
        "place": row["place"],
        "says": symbols(row["says"]),
        "verdict": row["verdict"],
        "measured": measured,
        "criterion": symbols(row["criterion"]),
        "because": symbols(row["because"]),
        "data": [results.say(name, name) for name in row["decided_by"]],
    }


def _value(value: float | str) -> str:
    return value if isinstance(value, str) else number(value, 4)


class Ledger:
    """The numbers of the ledger by claim, each linked to a dataset that decides the claim."""

    def __init__(self, results: Results):
        self._results = results
        self._all = load(results)
        self._rows = {name: row for row in self._all for name in row["names"]}

    def value(self, claim: str, key: str) -> float:
        """Return a measured number, NaN if the claim was not decided or is not applicable."""
        return float(self._rows[claim]["measured"].get(key, "nan").__str__().replace("none", "nan"))

    def quote(self, claim: str, key: str, digits: int = 3) -> Quote:
        """Return a measured number as the page shows it."""
        source = self._rows[claim]["decided_by"][0]
        return self._results.quote(source, self.value(claim, key), digits)

    def verdict(self, claim: str) -> str:
        """Return the verdict on a claim."""
        return self._rows[claim]["verdict"]

    def holds(self, claim: str) -> bool:
        """Return whether a claim is confirmed, with a caveat or without."""
        return self.verdict(claim) in (Verdict.CONFIRMED, Verdict.CAVEAT)

    def counts(self, place: str) -> list[tuple[str, int]]:
        """Return how many of the paper's claims on a place such as "Fig 5" have each verdict."""
        rows = [row for row in self._all if place in row["place"]]
        return list(tally(rows).get(Origin.PAPER, {}).items())

    def because(self, claim: str) -> str:
        """Return the reason of the verdict, in words."""
        return symbols(self._rows[claim]["because"])
