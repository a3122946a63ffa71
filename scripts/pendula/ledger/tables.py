"""The ledger as a table to read, and counts of its rows.

A sentence may be decided for a single run, for ensembles and for the infinite chain, by functions
of several studies. They make one row, which holds where all of them hold.
"""

from collections import Counter
from collections.abc import Iterable

from pendula.report.words import markdown

from .claim import Origin
from .criterion import REFUTED, Verdict
from .verdicts import controls_of

WORST_FIRST = (*REFUTED, Verdict.UNDECIDED, Verdict.NOT_APPLICABLE, Verdict.CAVEAT)
"""Verdicts in the order in which one of them is that of several readings; else all confirm."""


def by_sentence(rows: Iterable[dict]) -> list[dict]:
    """Return the rows of single claims with all readings of one sentence in one row."""
    sentences: dict[tuple, list[dict]] = {}
    for row in rows:
        sentences.setdefault((row["place"], row["says"]), []).append(row)
    return [
        readings[0] if len(readings) == 1 else _join(readings) for readings in sentences.values()
    ]


def _join(readings: list[dict]) -> dict:
    """Return one row: every number, reason and control with its reading, and the worst verdict."""
    parts = [_labelled(row) for row in readings]
    lists = [name for name, value in parts[0].items() if isinstance(value, list)]
    return {
        **readings[0],
        **{name: _without_repeats(one for row in parts for one in row[name]) for name in lists},
        "measured": {key: value for row in parts for key, value in row["measured"].items()},
        "reading": ", ".join(row["reading"] for row in readings),
        "criterion": "; ".join(filter(None, (row["criterion"] for row in parts))),
        "because": "; ".join(filter(None, (row["because"] for row in parts))),
        "verdict": min(readings, key=_from_the_worst)["verdict"],
    }


def _labelled(row: dict) -> dict:
    """Return a row whose numbers and words name its reading."""
    reading = row["reading"]
    prefix = reading.replace(" ", "_")
    named = {key: f"{reading}: {row[key]}" if row[key] else "" for key in ("criterion", "because")}
    measured = {f"{prefix}_{key}": value for key, value in row["measured"].items()}
    controls = [one | {"fed": f"{reading}: {one['fed']}"} for one in row["controls"]]
    return row | named | {"measured": measured, "controls": controls}


def _without_repeats(values: Iterable) -> list:
    kept: list = []
    for value in values:
        if value not in kept:
            kept.append(value)
    return kept


def _from_the_worst(row: dict) -> int:
    return [*map(str, WORST_FIRST), row["verdict"]].index(row["verdict"])


def tally(rows: Iterable[dict]) -> dict[str, dict[str, int]]:
    """Return by origin how many rows have each verdict; what no row has is left out."""
    counts = Counter((row["origin"], row["verdict"]) for row in rows)
    by_origin = {
        str(origin): {str(v): counts[origin, v] for v in Verdict if counts[origin, v]}
        for origin in Origin
    }
    return {origin: counted for origin, counted in by_origin.items() if counted}


def tables(rows: list[dict]) -> list[str]:
    """Return the parts of a page on these rows of the ledger."""
    claims = [[row[key] for key in ("name", "place", "says", "verdict")] for row in rows]
    return [
        "# What the paper says, and what the numbers say",
        "\n".join(f"- {line}" for line in counted(rows)),
        markdown(("name", "where", "claim", "verdict"), claims),
    ]


def in_short(rows: list[dict]) -> str:
    """Return how many rows have each verdict, and how many controls came out as required."""
    asked = [one["passes"] for one in controls_of(rows) if one["passes"] is not None]
    controls = f"{sum(asked)} of {len(asked)} controls came out as required"
    return "\n".join([*counted(rows), controls])


def counted(rows: list[dict]) -> list[str]:
    """Return a line for each origin of claims: how many there are, and with which verdicts."""
    return [
        f"{sum(verdicts.values())} claims {origin}: "
        + ", ".join(f"{n} {one.replace('does not', 'do not')}" for one, n in verdicts.items())
        for origin, verdicts in tally(rows).items()
    ]
