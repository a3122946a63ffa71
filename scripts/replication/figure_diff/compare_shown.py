"""Compares texts, pages and descriptions of figures with the accepted ones.

If all datasets have the accepted bits, the text must be equal. Otherwise a number may differ by the
tolerance or by its last digit. A larger difference is allowed only in entries that depend on a
dataset beyond comparison. In a ledger these are measured numbers and sentences with them, in a
figure the limits of axes and the ends of curves. Verdicts, criteria, cut-offs, labels and colours
must be equal.
"""

import json
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from latticode.datasets.digest import digest
from latticode.datasets.json_files import ENTRY, load_json
from latticode.datasets.netcdf import DatasetError, read

from . import Status, hashes, values
from .chaos import TOLERANCE

NUMBER = re.compile(r"(?<![A-Za-z_])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")

RULE = re.compile("-{3,}")
"""The line below the head of a table; its length depends on the width of the columns."""

OF_THE_MACHINE = {"report.html": re.compile(rb'<section id="run">.*?</section>', re.DOTALL)}
"""The part of a page about the machine: processor, package versions, and times of jobs."""

JOB = re.compile(rb'<tr><th scope="row">[\w/.]+</th><td>[\d.]+</td><td>\d+</td></tr>\n')
PROCESSOR = re.compile(rb'(<th scope="row">processor</th><td>)[^<]*')
VERSION_OR_TIME = re.compile(rb"\b\d[\w.+]*")

OF_THE_CODE = {
    "article.html": re.compile(rb'<div class="card" id="code_.*?</div>', re.DOTALL),
}
"""The source code shown in a page; it may change while all results stay the same."""

OF_VERSIONS = {
    "live.html": re.compile(rb'"code": "[\w+/=]*"'),
    "article.html": re.compile(rb'"data:image/png;base64,[\w+/=]*"|"code": "[\w+/=]*"'),
    "report.html": re.compile(rb' width="\d+" height="\d+"'),
}
"""The parts of a page that depend on package versions: compiled code, pictures or their sizes."""

FREE = {"because", "rests_on"}
"""Entries of a ledger whose texts depend on measured numbers."""

PLACES = {"limits", "x", "y", "extent", "points", "points_at", "stands_at"}
"""Entries of a description whose numbers depend on the data."""

ENDS = {"x", "y", "shows", "x leaves", "y leaves"}
"""Entries of a description that only curves with points have."""

LOOSE, FEW, LARGE = 0.6, 0.01, 10.0
"""Allowed effects of chaos: relative change of a number in PLACES, relative change of the number of
points, and factor of a measured number. Bands and bars may double their length. The limits of an
axis may scale with its curves, because one long bar doubles the limits."""

IN_TAGS = rb'<script type="application/json".*?</script>|<[^>]*>'
"""The separators between the words of a page: tags, and the data of the live page."""
DIGIT = re.compile(rb"\d")

Known = Mapping[str, Status]
"""The status of each dataset, by its name."""


def comparable(name: str, content: bytes) -> bytes:
    """Return the content of the file `name` without source code and facts about the machine.

    In the section on the machine, jobs and the processor are left out, and numbers are masked. If a
    page does not have exactly one such section, its facts about the machine are not left out.
    """
    if name in OF_THE_CODE:
        content = OF_THE_CODE[name].sub(b"", content)
    machine_texts = OF_THE_MACHINE[name].findall(content) if name in OF_THE_MACHINE else []
    if len(machine_texts) != 1:
        return content
    words = PROCESSOR.sub(rb"\1", JOB.sub(b"", machine_texts[0]))
    return content.replace(machine_texts[0], VERSION_OR_TIME.sub(b"#", words))


def hash_of(name: str, content: bytes) -> str:
    """Return the hash of a file, or three hashes of a page as one text.

    The three are of the matches of OF_VERSIONS, of the remaining page, and of its words. The words
    are the texts without digits; in the live page they are all texts.
    """
    compared = comparable(name, content)
    if not name.endswith(".html"):
        return hashes.of_bytes(compared)
    of_versions = b"".join(OF_VERSIONS[name].findall(compared)) if name in OF_VERSIONS else b""
    remaining = (
        OF_VERSIONS[name].sub(b"(of versions)", compared) if name in OF_VERSIONS else compared
    )
    words = re.split(IN_TAGS, compared)
    words = words if name == "live.html" else [text for text in words if not DIGIT.search(text)]
    return " ".join(map(hashes.of_bytes, (of_versions, remaining, b"|".join(words))))


def compare(new: Path, was: str, datasets: Known, same_drawing: bool = True) -> tuple[Status, str]:
    """Return status and reason of the text in `new`; the accepted text is `was`.

    `datasets` has the status of each dataset that the text uses. Without `same_drawing`, ticks may
    differ, because they depend on package versions.
    """
    is_json = new.suffix == ".json"
    try:
        now = new.read_text("utf-8")
        before, after = ((json.loads if is_json else _paragraphs)(text) for text in (was, now))
        if is_json and ENTRY in before:
            load_json(new)
    except (DatasetError, ValueError):
        return Status.DAMAGED, "has a wrong or missing checksum: it was edited or damaged"
    beyond, may_differ = 0, not set(datasets.values()) <= {Status.IDENTICAL}
    for path, *pair in _differences(before, after):
        if "ticks" in path and not same_drawing:
            judged = Status.BEYOND
        else:
            judged = _judge(path, *pair, (before, after), datasets) if may_differ else None
        if judged not in (Status.BEYOND, Status.WITHIN):
            return (
                Status.DIFFERENT,
                f"reads {_excerpts(*map(str, pair))} ({'.'.join(map(str, path))})",
            )
        beyond += judged == Status.BEYOND
    if beyond:
        return Status.BEYOND, f"{beyond} entries depend on numbers that cannot be compared"
    if not may_differ:
        return (
            Status.DIFFERENT,
            f"reads {_excerpts(was, now)}" if was != now else "shows other data",
        )
    return Status.WITHIN, "has the same words, and its numbers agree with the datasets"


def _paragraphs(text: str) -> list[str]:
    """Return the paragraphs and table rows of a text, without the padding of columns."""
    paragraphs = re.split(r"\n(?=[-|#]|\n)", RULE.sub("---", text))
    return [" ".join(paragraph.split()) for paragraph in paragraphs]


def _differences(was: Any, now: Any, path: tuple = ()) -> Iterator[tuple[tuple, Any, Any]]:
    """Yield the path, the accepted and the new value of each entry that differs."""
    if isinstance(was, dict) and isinstance(now, dict):
        for key in dict.fromkeys([*was, *now]):
            if key not in ("data", ENTRY):  # their checksums are checked elsewhere
                yield from _differences(was.get(key), now.get(key), (*path, key))
    elif isinstance(was, list) and isinstance(now, list) and len(was) == len(now):
        for place, pair in enumerate(zip(was, now, strict=True)):
            yield from _differences(*pair, (*path, place))
    elif was != now:
        yield path, was, now


def _judge(path: tuple, was: Any, now: Any, texts: tuple, datasets: Known) -> Status:
    """Return the status of an entry with the value `now` instead of `was`.

    `texts` are the accepted and the new content; `path` leads to the entry in both of them.
    """
    entries = {key for key in path if isinstance(key, str)}
    chaotic = _follows_chaos(path, entries, texts[0], datasets)
    if chaotic and (entries & FREE or ("ticks" in entries and "x" not in entries)):
        return Status.BEYOND
    if chaotic and "measured" in entries and {was, now} & {None, "infinite"}:
        return Status.BEYOND
    if chaotic and {*path[-1:]} & ENDS and 0 in [_points_on(path[:-1], each) for each in texts]:
        return Status.BEYOND
    if _words(str(was)) != _words(str(now)):
        return Status.DIFFERENT
    pairs = zip(*(NUMBER.findall(str(each)) for each in (was, now)), strict=True)
    off = [(float(a), float(b)) for a, b in pairs if not _close(a, b)]
    if all(values.are_roundings(*pair) for pair in off):
        return Status.BEYOND if off else Status.WITHIN
    if chaotic and "measured" in entries:
        may_be = all(abs(b) <= LARGE * max(abs(a), 1.0) for a, b in off)
    elif chaotic and isinstance(was, str):
        may_be = bool(entries & {"text", "title"})
    elif chaotic and entries & PLACES and not {"x", "limits"} <= entries:
        may_be = _is_near(path, was, now, *texts)
    else:
        may_be = False
    return Status.BEYOND if may_be else Status.DIFFERENT


def _points_on(path: tuple, text: Any) -> int | None:
    """Return the number of points of a curve, or None if `path` does not lead to a curve."""
    curve = _entry(text, path)
    return curve.get("points") if isinstance(curve, dict) else None


def _is_near(path: tuple, was: float, now: float, before: Any, after: Any) -> bool:
    """Return whether chaos may explain the difference of a limit or an end of a curve."""
    points = [_points_on(path[:-2], text) for text in (before, after)]
    if points[0] != points[1]:  # the ends of the curve are other points
        return True
    if path[-1] == "points":  # a logarithmic curve has gaps, or a state has just formed
        return abs(now - was) <= max(2.0, FEW * was)
    panels = [_entry(text, path[:2]) for text in (before, after)]
    if "y" in path and panels[0]["y"].get("scale") == "log":
        return 1 / values.SCATTER <= now / was <= values.SCATTER
    ends, grown = _entry(before, path[:-1]), 1.0
    largest = max(map(abs, ends if isinstance(ends, list) else [was]))
    if "limits" in path and "y" in path:
        reached, reaches = map(_reach, panels)
        grown = reaches / reached if reached else 1.0
    is_bar = "areas" in path or ("curves" in path and _entry(before, path[:4])["line"] == "None")
    if is_bar and points[0] == 1:  # the end of a bar may be close to zero
        largest = max(largest, _reach(panels[0]))
    off, allowed = now - was * grown, LOOSE * largest * grown
    return -allowed <= off <= (largest if is_bar else allowed)


def _reach(panel: Mapping[str, Any]) -> float:
    """Return the largest distance from zero of the curves, bands and bars of a panel."""
    drawn = [*panel.get("curves", ()), *panel.get("areas", ())]
    return max((abs(end) for entry in drawn for end in entry.get("y", ())), default=0.0)


def _entry(content: Any, path: tuple) -> Any:
    for key in path:
        content = content[key]
    return content


def _follows_chaos(path: tuple, entries: set[str], content: Any, datasets: Known) -> bool:
    """Return whether an entry depends on a dataset that is beyond comparison.

    A row of a ledger depends on the datasets that decide its claim. Its controls use further
    datasets, so for them all datasets count.
    """
    names = datasets.keys()
    if path[:1] == ("rows",) and len(path) > 2 and "controls" not in entries:
        names = {f"{name}.nc" for name in _entry(content, path[:2])["decided_by"]} & names
    return any(datasets[name] == Status.BEYOND for name in names)


def _words(text: str) -> str:
    """Return a text without its numbers."""
    return "#".join(" ".join(between.split()) for between in NUMBER.split(text))


def _close(was: str, now: str) -> bool:
    """Return whether two numbers agree within the tolerance or one unit of the last digit."""
    last = max(Decimal(number).as_tuple().exponent for number in (was, now))
    digit = 1.01 * 10.0**last if last < 0 else 0.0  # integers have no last digit
    return abs(float(now) - float(was)) <= max(TOLERANCE * abs(float(was)), digit)


def _excerpts(was: str, now: str) -> str:
    """Return excerpts of both texts around their first difference."""
    differing = (i for i, letters in enumerate(zip(was, now, strict=False)) if len({*letters}) > 1)
    first = next(differing, min(len(was), len(now)))
    excerpts = (" ".join(text[max(0, first - 30) : first + 30].split()) for text in (now, was))
    return " in place of ".join(f'"{excerpt}"' for excerpt in excerpts)


def compare_description(
    accepted: Path, new: Path, data: Status, same_drawing: bool
) -> tuple[Status, str]:
    """Return status and reason of a description; `data` is the status of its dataset."""
    try:
        text = new.read_text("utf-8")
        data_digest, described = digest(read(new.with_suffix(".nc"))), json.loads(text)["data"]
    except (DatasetError, ValueError, KeyError, TypeError):
        return Status.DAMAGED, "cannot be read, or its dataset cannot"
    if described != data_digest:
        return Status.DIFFERENT, "describes data that are not in its dataset"
    was = accepted.read_text("utf-8")
    same = Status.IDENTICAL, ""
    return same if text == was else compare(new, was, {"": data}, same_drawing)
