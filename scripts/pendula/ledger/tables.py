"""The ledger as a table to read, and counts of its rows."""

from collections import Counter
from collections.abc import Iterable

from pendula.report.words import markdown

from .claim import Origin
from .criterion import Verdict


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


def tables(rows: list[dict]) -> list[str]:
    """Return the parts of a page on these rows of the ledger."""
    claims = [[row[key] for key in ("name", "place", "says", "verdict")] for row in rows]
    return [
        "# What the paper says, and what the numbers say",
        "\n".join(f"- {line}" for line in counted(rows)),
        markdown(("name", "where", "claim", "verdict"), claims),
    ]
