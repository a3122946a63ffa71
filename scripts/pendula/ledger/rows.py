"""The rows of the ledger: the readings of one sentence joined, and how many rows there are.

A sentence may be decided for a single run, for ensembles and for the infinite chain, by functions
of several studies. They make one row, which holds where all of them hold.
"""

from collections import Counter
from collections.abc import Iterable

from .claim import Origin
from .criterion import REFUTED, Verdict

WORST_FIRST = (*REFUTED, Verdict.UNDECIDED, Verdict.NOT_APPLICABLE, Verdict.CAVEAT)
"""Verdicts in the order in which one of them is that of several readings; else all confirm."""


def joined(rows: Iterable[dict]) -> list[dict]:
    """Return the rows of single claims with all readings of one sentence in one row."""
    sentences: dict[tuple, list[dict]] = {}
    for row in rows:
        sentences.setdefault((row["place"], row["says"]), []).append(row)
    return [
        readings[0] if len(readings) == 1 else _join(readings) for readings in sentences.values()
    ]


def _join(readings: list[dict]) -> dict:
    """Return one row: every number, reason and control with its reading, and the worst verdict."""
    verdicts = {row["verdict"] for row in readings}
    parts = [_labelled(row) for row in readings]
    lists = [name for name, value in parts[0].items() if isinstance(value, list)]
    return {
        **readings[0],
        **{name: _without_repeats(one for row in parts for one in row[name]) for name in lists},
        "measured": {key: value for row in parts for key, value in row["measured"].items()},
        "reading": ", ".join(row["reading"] for row in readings),
        "criterion": "; ".join(filter(None, (row["criterion"] for row in parts))),
        "because": "; ".join(filter(None, (row["because"] for row in parts))),
        "verdict": next((str(one) for one in WORST_FIRST if one in verdicts), "confirmed"),
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


def tally(rows: Iterable[dict]) -> dict[str, dict[str, int]]:
    """Return by origin how many rows have each verdict; what no row has is left out."""
    counts = Counter((row["origin"], row["verdict"]) for row in rows)
    by_origin = {
        str(origin): {str(v): counts[origin, v] for v in Verdict if counts[origin, v]}
        for origin in Origin
    }
    return {origin: counted for origin, counted in by_origin.items() if counted}
