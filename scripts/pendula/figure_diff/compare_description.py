"""Compares what two figures show, as `drawing.description` writes it beside them: texts as texts.

If the drawn data have the accepted bits, nothing may differ, on any machine and with any version of
matplotlib. If they have moved, words, colours, scales, and the number of panels and curves must
still be the same. Limits and positions that follow the data may move as far as MAY_MOVE says.
"""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from pendula.datasets.digest import digest, fingerprint
from pendula.datasets.netcdf import DatasetError, read

from . import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding, Motion

FOLLOWS = 0.3
"""How far limits and positions may move with chaotic data: so much of the axis, on a logarithmic
one of its decades. The reason: limits of a panel are the extremes of its curves. Whole
reproductions from data that differ by 1e-15 moved one by 0.19 (the rare smallest value in
`bounds`), and limits that are cut by half move by 0.5."""

INVISIBLE = 1e-4
"""How far limits, positions and ranges may move with data of other bits that are regular."""

MAY_MOVE = {
    Motion.NONE: 0.0,
    Motion.UNSEEN: INVISIBLE,
    Motion.SEEN: FOLLOWS,
    Motion.WRONG: INVISIBLE,  # wrong data excuse nothing that regular data do not
}

MANY = 10
"""Of a curve with so many points at most half may come or go with chaotic data: gaps of a
logarithmic axis move, but a curve does not vanish."""

ROUNDING = 1e-8
"""A logarithmic axis that begins lower shows errors of rounding, which keep their size only."""

ITEMS = {
    "panels": "panel",
    "legends": "legend",
    "entries": "entry",
    "curves": "curve",
    "areas": "area",
    "images": "image",
    "shapes": "shape",
    "texts": "text",
}
"""Lists of a description, and how one of their items is called."""

NAMES = ("title", "label", "text")
"""The first of these that an item has names it among the others of its kind."""


class DamagedDescriptionError(ValueError):
    """A description that cannot be read; the message says why, and the finding names the file."""


class Described(NamedTuple):
    """A description, and the fingerprint of its text, which PNG and PDF carry."""

    content: dict[str, Any]
    fingerprint: str


class Difference(NamedTuple):
    """One difference: where, what was and what is, and the least allowance that lets it pass."""

    says: str
    least: float


def read_description(path: Path) -> Described:
    """Read a description; DamagedDescriptionError says what is wrong with one."""
    try:
        text = path.read_text(encoding="utf-8")
        content = json.loads(text)
        complete = {"data", "size_in_inches", "panels"} <= content.keys()
    except FileNotFoundError:
        raise DamagedDescriptionError("has no description beside it") from None
    except (ValueError, AttributeError):
        complete = False
    if not complete:
        raise DamagedDescriptionError("has a description that cannot be read")
    return Described(content, fingerprint(text))


def shows_rounding(path: Path) -> bool:
    """Return whether a panel has a logarithmic axis on which errors of rounding can be seen.

    There any other bits move curves visibly. A description that cannot be read shows nothing.
    """
    try:
        panels = read_description(path).content["panels"]
    except DamagedDescriptionError:
        return False
    axes = [panel[name] for panel in panels for name in "xy" if name in panel]
    return any(axis["scale"] == "log" and min(axis["limits"]) < ROUNDING for axis in axes)


def compare(name: str, accepted: Path, made: Path, data: Path, motion: Motion) -> Finding:
    """Return the finding for the description `made` of the figure that shows the dataset `data`.

    `motion` is that of the dataset.
    """
    try:
        was, now = (read_description(path) for path in (accepted, made))
        shown = digest(read(data))
    except DamagedDescriptionError as error:
        return Finding(name, DAMAGED, f"the figure {error}")
    except DatasetError:
        return Finding(name, DAMAGED, f"describes {data.name}, which cannot be read")
    if now.content["data"] != shown:
        return Finding(name, DIFFERENT, f"describes other data than {data.name} holds")
    if was.fingerprint == now.fingerprint:
        return Finding(name, IDENTICAL)
    return judge(name, was.content, now.content, motion)


def judge(name: str, was: dict, now: dict, motion: Motion) -> Finding:
    """Return the finding for two descriptions that are not the same text."""
    allowed = MAY_MOVE[motion]
    found = list(differences(was, now))
    beyond = [each for each in found if each.least > allowed]
    faults = [each.says for each in sorted(beyond, key=lambda each: -each.least)]
    if faults:
        more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
        return Finding(name, DIFFERENT, faults[0] + more)
    if was["data"] == now["data"]:
        return Finding(name, DIFFERENT, "is written otherwise, although it says the same")
    says = "shows data of other bits; all words, colours and scales are the same"
    if found:
        says += f", and {len(found)} limits, positions or ranges follow the data"
    return Finding(name, NEARLY, says)


def differences(was: dict, now: dict) -> Iterator[Difference]:
    """Yield all differences of two descriptions but the digests of their data."""
    shown = [{key: part for key, part in each.items() if key != "data"} for each in (was, now)]
    yield from _of_items("", *shown, {})


def _of_items(where: str, was: dict, now: dict, axes: dict[str, dict]) -> Iterator[Difference]:
    """Yield the differences of two items; `axes` are those of the panel around them."""
    axes = {key: was[key] for key in "xy" if isinstance(was.get(key), dict)} or axes
    for key in {**was, **now}:
        before, after = was.get(key), now.get(key)
        if key in ITEMS:
            yield from _of_lists(where, key, before or [], after or [], axes)
        elif isinstance(before, dict) and isinstance(after, dict):
            yield from _of_items(f"{where}{key} axis: ", before, after, {key: before})
        elif before != after:
            says = f"{where}{key.replace('_', ' ')} is {_told(after)} in place of {_told(before)}"
            yield Difference(says, _least_allowance(key, was, now, axes))


def _of_lists(
    where: str, key: str, was: list[dict], now: list[dict], axes: dict
) -> Iterator[Difference]:
    if len(was) != len(now):
        yield Difference(f"{where}has {_count(key, now)} in place of {_count(key, was)}", math.inf)
        return
    for number, (before, after) in enumerate(zip(was, now, strict=True), 1):
        name = next((f" '{before[part]}'" for part in NAMES if part in before), "")
        yield from _of_items(f"{where}{ITEMS[key]} {number}{name}: ", before, after, axes)


def _count(key: str, items: list) -> str:
    return f"{len(items)} {ITEMS[key] if len(items) == 1 else key}"


def _told(part: Any) -> str:
    return "absent" if part is None else json.dumps(part, ensure_ascii=False)


def _least_allowance(key: str, was: dict, now: dict, axes: dict[str, dict]) -> float:
    """Return how far moved data must be allowed to move the part `key` of an item, or infinity."""
    before, after = was.get(key), now.get(key)
    if key == "ticks":
        return INVISIBLE  # they follow the limits, and the room that labels leave to a panel
    if before is None or after is None:
        return math.inf
    if key == "points":
        return FOLLOWS if max(before, after) < max(MANY, 2 * min(before, after) + 1) else math.inf
    if key == "limits":
        return max(_moved(*pair, was) for pair in zip(before, after, strict=True))
    in_data = {"stands_at": was.get("off") == "data", "points_at": was.get("of") == "data"}
    if in_data.get(key) and axes:
        pairs = zip(before, after, "xy", strict=True)
        return max(_moved(old, new, axes[axis]) for old, new, axis in pairs)
    if key in axes:  # the range of a curve, whose dataset has been compared with its own allowances
        apart = max(_moved(*pair, axes[key]) for pair in zip(before, after, strict=True))
        return min(apart, FOLLOWS)
    return math.inf


def _moved(was: float, now: float, axis: dict) -> float:
    """Return how far a number moved, as a part of the axis, or of the limits of a colour bar."""
    numbers = [was, now, *axis["limits"]]
    if "log" in axis["scale"].lower():
        if min(numbers) <= 0:
            return 0.0 if was == now else math.inf
        numbers = [math.log10(number) for number in numbers]
    before, after, first, last = numbers
    return abs(after - before) / (abs(last - first) or 1.0)
