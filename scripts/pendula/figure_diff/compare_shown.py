"""Compares texts and pictures with the accepted ones: words must be equal, numbers follow the data.

Where all datasets have the accepted bits, not a letter may differ. Else a number may be off by the
tolerance or by its last digit. Only where a dataset is beyond comparison may it be off by more, and
nobody can judge it here; verdicts, sentences, labels and colours in JSON must still be equal.

A picture carries the fingerprint of the description beside it (`drawing.description`), and that the
digest of the data: so one of other data, an older run or another figure is told on any machine. Its
pixels are not compared: with other bytes it is a fault where the accepted versions drew it.
"""

import json
import re
from decimal import Decimal
from io import BytesIO
from pathlib import Path
from typing import Any

from latticode.datasets.digest import digest, fingerprint
from latticode.datasets.json_files import ENTRY, load_json
from latticode.datasets.netcdf import DatasetError, read
from PIL import Image

from . import Status
from .chaos import ROUNDING, TOLERANCE

NUMBER = re.compile(r"(?<![A-Za-z_])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")

RULE = re.compile("-{3,}")
"""The line below the head of a table, as wide as its columns."""

OF_THE_MACHINE = {
    "report.html": rb'<section id="run">(?:(?!</?section).)*</section>',
    "live.html": rb'"code": "[\w+/=]*"',
}
"""What two pages hold of the machine, each once: processor, versions and times of jobs; and code
that numba writes for the processor, whose bits are compared where it runs."""

FOLLOWS = ("data", ENTRY, "ticks", "points", "measured", "because", "cutoffs", "rests_on", "checks")
"""Entries of a description, and of a ledger, whose words follow the numbers of chaotic datasets."""

CHECKSUMS = re.compile(r'"(?:data|sha256)": "[0-9a-f]{64}"')


def comparable(name: str, content: bytes) -> bytes:
    """Return what is compared of the file `name` of a run: of a page, not what is of the machine.

    A mark stays in its place, so that it cannot be lost; where it stands twice, all is compared.
    """
    if name not in OF_THE_MACHINE:
        return content
    around = re.split(OF_THE_MACHINE[name], content, flags=re.DOTALL)
    return b"(of the machine)".join(around) if len(around) == 2 else content


def compare(new: Path, was: str, datasets: set[Status]) -> tuple[Status, str]:
    """Return status and reason of the text in `new`, which rests on `datasets`, beside `was`."""
    chaotic, is_json = Status.BEYOND in datasets, new.suffix == ".json"
    try:
        now = new.read_text("utf-8")
        if is_json and ENTRY in json.loads(was):
            load_json(new)
    except (DatasetError, ValueError):
        return Status.DAMAGED, "has a wrong checksum, or none: it was edited or damaged"
    if chaotic and is_json:
        steady = [_words(json.dumps(_steady(json.loads(text)))) for text in (was, now)]
        if steady[0] != steady[1]:
            return Status.DIFFERENT, f"has different words: {_beside(*steady)}"
    texts = [CHECKSUMS.sub('""', RULE.sub("---", text)) for text in (was, now)]
    words = [_words(text) for text in texts]
    if words[0] != words[1]:
        status = Status.BEYOND if chaotic else Status.DIFFERENT
        return status, f"has different words: {_beside(*words)}"
    pairs = list(zip(*(NUMBER.findall(text) for text in texts), strict=True))
    off = [pair for pair in pairs if not _close(*pair)]
    told = off and f"{len(off)} numbers differ, such as {off[0][1]} in place of {off[0][0]}"
    tiny = any(max(abs(float(number)) for number in pair) < ROUNDING for pair in off)
    if off and (chaotic or (tiny and Status.WITHIN in datasets)):
        return Status.BEYOND, f"{told}; they cannot be compared, because some datasets cannot"
    if off or not datasets & {Status.WITHIN, Status.BEYOND}:
        unlike = "shows other data" if texts[0] == texts[1] else f"reads {_beside(*texts)}"
        return Status.DIFFERENT, told or unlike
    return Status.WITHIN, "follows the datasets, with the same words"


def _steady(part: Any) -> Any:
    """Return the content of JSON without what follows chaotic datasets."""
    if isinstance(part, list):
        return [_steady(each) for each in part]
    if isinstance(part, dict):
        return {key: _steady(each) for key, each in part.items() if key not in FOLLOWS}
    return part


def _words(text: str) -> str:
    """Return a text without its numbers."""
    return "#".join(" ".join(part.split()) for part in NUMBER.split(text))


def _close(was: str, now: str) -> bool:
    """Return whether two numbers agree to the tolerance, or to the last digit that is printed."""
    last = max(Decimal(number).as_tuple().exponent for number in (was, now))
    digit = 1.01 * 10.0**last if last < 0 else 0.0  # whole numbers are exact
    return abs(float(now) - float(was)) <= max(TOLERANCE * abs(float(was)), digit)


def _beside(was: str, now: str) -> str:
    """Return both texts from shortly before the first letter in which they differ."""
    apart = (i for i, letters in enumerate(zip(was, now, strict=False)) if len({*letters}) > 1)
    first = next(apart, min(len(was), len(now)))
    parts = (" ".join(text[max(0, first - 30) : first + 30].split()) for text in (now, was))
    return " in place of ".join(f'"{part}"' for part in parts)


MARK = re.compile(rb"(?:Description\0|/Keywords \()([0-9a-f]{64})")
"""Where a PNG and a PDF carry the fingerprint of their description."""


def compare_description(accepted: Path, new: Path, data: Status) -> tuple[Status, str]:
    """Return status and reason of a description; `data` is the status of the dataset beside it."""
    try:
        text = new.read_text("utf-8")
        shown, described = digest(read(new.with_suffix(".nc"))), json.loads(text)["data"]
    except (DatasetError, ValueError, KeyError, TypeError):
        return Status.DAMAGED, "it, or the dataset that it describes, cannot be read"
    if described != shown:
        return Status.DIFFERENT, "describes other data than the dataset beside it holds"
    was = accepted.read_text("utf-8")
    return (Status.IDENTICAL, "") if text == was else compare(new, was, {data})


def compare_picture(new: Path, same_bytes: bool, described: Status) -> tuple[Status, str]:
    """Return status and reason of a PNG or a PDF; `described` is the status of its description."""
    content, text = new.read_bytes(), new.with_suffix(".json")
    if fault := damage(new, content):
        return Status.DAMAGED, fault
    mark = MARK.search(content)
    if not (mark and text.exists() and mark[1].decode() == fingerprint(text.read_text("utf-8"))):
        stale = "was not written with its description: it is stale, or of another figure"
        return Status.DIFFERENT, stale
    if same_bytes:
        return Status.IDENTICAL, ""
    if described.is_fault:
        return Status.DIFFERENT, "shows what its description says, which is a fault"
    return Status.BEYOND, f"other bytes, which belong to its description; that is {described}"


def damage(path: Path, content: bytes) -> str:
    """Return in words why a picture is not whole, or nothing."""
    if path.suffix == ".pdf":
        whole = content.startswith(b"%PDF-") and content.rstrip().endswith(b"%%EOF")
        return "" if whole else "is no whole PDF"
    try:
        Image.open(BytesIO(content)).verify()  # checksums, at which `load` does not look
        Image.open(BytesIO(content)).load()
    except (OSError, SyntaxError, ValueError):
        return "is no whole PNG"
    return ""
