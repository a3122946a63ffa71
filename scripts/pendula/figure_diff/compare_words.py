"""Compares what is made of words: the ledger and its controls row by row, tables line by line.

All their numbers come from datasets, so the datasets decide how far a number may differ. If every
dataset holds its bits, not a letter may change. If some differ by less than one can see, a number
may change by STEADY of itself. If some moved visibly (in chaos, within what statistics allow), a
number may change by a factor of WITH_CHAOS. No verdict, no other word, and nothing but what a claim
measured and what it concludes may change.
"""

import json
import re
from collections.abc import Iterable, Mapping

from . import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding, Motion

LEDGERS = ("claims.json", "controls.json")
"""Files of rows; any other is compared line by line."""

NUMBER = re.compile(r"(?<![A-Za-z_])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")

STEADY = 1e-4
"""How far a number may follow a dataset that did not move visibly: a hundred times what a regular
curve may, since a difference or a rate of such curves moves more than they do."""

WITH_CHAOS, ERRORS_WITH_CHAOS, ERROR = 2.0, 10.0, 0.1
"""A number may follow chaos by the first factor, which the statistics of single curves reach too. A
number below ERROR may follow by the second: drifts, uncertainties and differences of two solvers
are samples of wide laws."""

ROUNDING = 1e-8
"""Errors below this are made of roundings, and keep their size only: a factor of ten."""

FOLLOW = re.compile(r".*: (controls \d+ )?(measured|because)\b")
"""Which parts of a row of a ledger come from the data. Thresholds and sentences do not."""


def compare(name: str, accepted: str, made: str, datasets: Mapping[str, Motion]) -> Finding:
    """Return the finding for a text; `datasets` says of all datasets by name how far they moved."""
    try:
        was, now = (pieces(name, text) for text in (accepted, made))
    except (ValueError, KeyError, TypeError, AttributeError):
        return Finding(name, DAMAGED, "is no list of rows as the ledger writes it")
    verdicts, faults, followed = [], _unmatched(was, now), []
    for key in was:
        if key in now and was[key] != now[key]:
            follows = name not in LEDGERS or FOLLOW.match(key)
            motions = _motions(name, key, made, datasets) if follows else set()
            allowed = _may_follow(was[key], now[key], motions)
            is_verdict = key.endswith(": verdict")
            told = verdicts if is_verdict else followed if allowed else faults
            told.append(f"{key} is {_beside(now[key], was[key])}")
    if verdicts or faults:
        said = [*verdicts, *([_first(faults)] if faults else [])]
        return Finding(name, DIFFERENT, "; ".join(said))
    if followed:
        return Finding(name, NEARLY, f"follows the datasets: {_first(followed)}")
    if list(was) != list(now):
        return Finding(name, DIFFERENT, "has its rows in another order")
    if accepted != made:
        return Finding(name, DIFFERENT, "is written otherwise, although it says the same")
    return Finding(name, IDENTICAL)


def pieces(name: str, text: str) -> dict[str, str]:
    """Return the text in pieces, by where each stands."""
    if name not in LEDGERS:
        return dict(_cells(text))
    found = {}
    for row in json.loads(text):
        who = row["name"] if "name" in row else f"{row['claim']} fed {row['fed']}"
        found |= {f"{who}: {key}": value for key, value in _leaves(row)}
    return found


def _cells(text: str) -> Iterable[tuple[str, str]]:
    """Yield each line, and of tables each cell; the padding of columns says nothing."""
    for number, line in enumerate(text.splitlines(), 1):
        cells = [re.sub("-{3,}", "---", cell.strip()) for cell in line.strip(" |").split(" | ")]
        for column, cell in enumerate(cells, 1):
            where = f", column {column} of {_quoted(cells[0])}" if len(cells) > 1 else ""
            yield f"line {number}{where}", cell


def verdicts(text: str) -> dict[str, str]:
    """Return the verdicts of a ledger by the names of the claims."""
    return {row["name"]: row["verdict"] for row in json.loads(text)}


def _leaves(value, place: str = "") -> Iterable[tuple[str, str]]:
    if isinstance(value, dict | list):
        entries = value.items() if isinstance(value, dict) else enumerate(value, 1)
        for key, entry in entries:
            yield from _leaves(entry, f"{place} {key}".strip())
    else:
        yield place, str(value)


def _unmatched(was: Mapping[str, str], now: Mapping[str, str]) -> list[str]:
    gone = [f"{key} is gone: {_quoted(was[key])}" for key in was if key not in now]
    return gone + [f"{key} is new: {_quoted(now[key])}" for key in now if key not in was]


def _motions(name: str, key: str, made: str, datasets: Mapping[str, Motion]) -> set[Motion]:
    """Return how far the datasets moved that a number may follow: of a claim, those that decide."""
    if name != "claims.json" or ": controls" in key:
        return {*datasets.values()}
    claim = key.partition(":")[0]
    deciding = next(row["decided_by"] for row in json.loads(made) if row["name"] == claim)
    return {datasets[f"{each}.nc"] for each in deciding if f"{each}.nc" in datasets}


def _may_follow(was: str, now: str, motions: set[Motion]) -> bool:
    """Return whether two texts differ in numbers alone, and by no more than their datasets do."""
    if motions <= {Motion.NONE} or NUMBER.sub("#", was) != NUMBER.sub("#", now):
        return False
    pairs = list(zip(NUMBER.findall(was), NUMBER.findall(now), strict=True))
    steady = all(_close(*pair) for pair in pairs)
    return steady or (Motion.SEEN in motions and all(_keeps_its_size(*pair) for pair in pairs))


def _close(was: str, now: str) -> bool:
    """Return whether two numbers agree to STEADY, to their last digit, or in size if tiny."""
    before, after = float(was), float(now)
    apart, larger = abs(after - before), max(abs(before), abs(after))
    if larger < ROUNDING:
        return larger <= 10 * min(abs(before), abs(after)) or larger < 1e-12
    return apart <= max(STEADY * larger, 1.01 * max(map(_last_place, (was, now))))


def _keeps_its_size(was: str, now: str) -> bool:
    """Return whether a number changed by no more than chaos may change it."""
    least, most = sorted((float(was), float(now)), key=abs)
    factor = WITH_CHAOS if abs(most) >= ERROR else ERRORS_WITH_CHAOS
    return _close(was, now) or (least * most > 0 and abs(most) <= factor * abs(least))


def _last_place(number: str) -> float:
    """Return the size of one unit of the last digit that is printed."""
    digits, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


def _quoted(text: str) -> str:
    short = text if len(text) <= 60 else text[:57] + "..."
    return f'"{short}"'


def _beside(now: str, was: str) -> str:
    """Return both texts in words, from shortly before the first letter in which they differ."""
    apart = (i for i, letters in enumerate(zip(now, was, strict=False)) if len({*letters}) > 1)
    first = next(apart, min(len(now), len(was)))
    cut = max(0, first - 20) if max(len(now), len(was)) > 60 else 0
    ends = [f"...{text[cut:]}" if cut else text for text in (now, was)]
    return " in place of ".join(map(_quoted, ends))


def _first(said: list[str]) -> str:
    return said[0] + (f" (and {len(said) - 1} more)" if len(said) > 1 else "")
