"""Compares a PDF with what it must show: it is whole, belongs to its data, and is as accepted.

Each PDF carries the fingerprint of the description that was written with it, and the description
the digest of the data. So a PDF that is older than its data, or of another figure, is told on any
machine. Where versions are those of the baseline, its content must be the accepted one as well, to
the last bit. Content is what its streams hold after they are unpacked, because libraries pack the
same bytes in different ways.

matplotlib writes every object plainly, with a table of where each begins, so a few expressions read
it; no package among the pins reads PDF.
"""

import re
import zlib
from pathlib import Path
from typing import NamedTuple

from . import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding, hashes
from .compare_description import DamagedDescriptionError, Described, read_description

POINTS = 72
"""Points per inch: the unit of a page's size."""
LEAST_STROKES = 2
"""A page of this project with fewer lines or areas than this would show nothing."""

END = re.compile(rb"startxref\s+(\d+)\s+%%EOF\s*$")
ENTRY = re.compile(rb"(\d{10}) \d{5} n")
OBJECT = re.compile(rb"(\d+) 0 obj\s")
HEAD_ENDS = re.compile(rb"\s(stream\r?\n|endobj)")
LENGTH = re.compile(rb"/Length (\d+)( 0 R)?")
INFO = re.compile(rb"/Info (\d+) 0 R")
ROOT = re.compile(rb"/Root (\d+) 0 R")
MARK = re.compile(rb"/Keywords \(([0-9a-f]+)\)")
PAGE = re.compile(rb"/Type /Page\b")
SIZE = re.compile(rb"/MediaBox \[ *0 0 ([\d.]+) ([\d.]+) *\]")
CONTENTS = re.compile(rb"/Contents (\d+) 0 R")
STROKES = re.compile(rb"(?<=\s)(?:S|s|[fBb]\*?|Do)(?=\s)")
"""Operators that leave a mark: stroke, fill, both, or an image."""


class DamagedPDFError(ValueError):
    """A PDF that cannot be read; the message says why, and the finding names the file."""


class PDF(NamedTuple):
    """What is compared of a PDF."""

    pages: int
    inches: tuple[float, float]
    """Width and height of the first page."""
    strokes: int
    """How many lines, areas and images its first page draws."""
    mark: str
    """The fingerprint of the description that it was written with."""
    content: str
    """The hash of its unpacked objects, and of the trailer, which says where a viewer begins."""


def read(path: Path) -> PDF:
    """Read a PDF that matplotlib wrote, completely, so that damage shows here."""
    data = path.read_bytes()
    if not data:
        raise DamagedPDFError("is empty")
    objects = _objects(data)
    pages = [text for text in objects.values() if PAGE.search(text)]
    if not pages or not (size := SIZE.search(pages[0])):
        raise DamagedPDFError("has no page")
    width, height = (float(points) / POINTS for points in size.groups())
    trailer = data[data.rindex(b"trailer") : data.rindex(b"startxref")]
    root = ROOT.search(trailer)
    if root is None or b"/Type /Catalog" not in objects.get(int(root[1]), b""):
        raise DamagedPDFError("is damaged: its root is no catalog of pages")
    drawn, info = CONTENTS.search(pages[0]), INFO.search(trailer)
    strokes = len(STROKES.findall(objects.get(int(drawn[1]), b""))) if drawn else 0
    marked = MARK.search(objects.get(int(info[1]), b"")) if info else None
    # numbers that stand alone are packed lengths
    told = [objects[number] for number in sorted(objects) if not objects[number].isdigit()]
    content = hashes.of_bytes(b"\n".join([*told, trailer]))
    return PDF(len(pages), (width, height), strokes, marked[1].decode() if marked else "", content)


def _objects(data: bytes) -> dict[int, bytes]:
    """Return the unpacked objects by their numbers, found by the table at the end of the file."""
    end = END.search(data)
    if not data.startswith(b"%PDF-") or end is None or b"trailer" not in data:
        raise DamagedPDFError("is no whole PDF: its beginning or its end is missing")
    begins = [int(entry[1]) for entry in ENTRY.finditer(data, int(end[1]))]
    heads = [OBJECT.match(data, begin) for begin in begins]
    # a viewer takes the entries of the table for objects 1, 2, ..., whatever stands there
    if not heads or [head and int(head[1]) for head in heads] != list(range(1, len(heads) + 1)):
        raise DamagedPDFError("is damaged: objects are not where its table says")
    places = {int(head[1]): head.end() for head in heads}
    return {number: _unpack(data, number, places) for number in places}


def _unpack(data: bytes, number: int, places: dict[int, int]) -> bytes:
    """Return the text of an object, its stream unpacked and without the packed length."""
    head = HEAD_ENDS.search(data, places[number])
    if head is None:
        raise DamagedPDFError(f"is damaged: object {number} does not end")
    text = data[places[number] : head.start()]
    if head[1] == b"endobj":
        return text
    size = LENGTH.search(text)
    if size is None:
        raise DamagedPDFError(f"is damaged: object {number} has no length")
    length = int(_unpack(data, int(size[1]), places)) if size[2] else int(size[1])
    stream = data[head.end() : head.end() + length]
    if b"/FlateDecode" in text:
        try:
            stream = zlib.decompress(stream)
        except zlib.error as error:
            raise DamagedPDFError(f"is damaged: object {number}: {error}") from None
    return LENGTH.sub(b"", text) + stream


def compare(
    name: str, accepted: str, made: Path, descriptions: tuple[Path, Path], exact: bool
) -> Finding:
    """Return the finding for the PDF `made`; `accepted` is what the baseline keeps of it.

    `descriptions` are those of the baseline and of the run; `accepted` is the hash of the accepted
    content; `exact` says that the versions are those that drew it.
    """
    try:
        found, was, now = read(made), *(read_description(path) for path in descriptions)
    except (DamagedPDFError, DamagedDescriptionError) as error:
        return Finding(name, DAMAGED, f"the PDF {error}")
    if fault := _unlike(found, now):
        return Finding(name, DIFFERENT, fault)
    if found.content == accepted:
        return Finding(name, IDENTICAL)
    if was.fingerprint != now.fingerprint:
        says = "belongs to its data, which have moved, and is compared by its description"
        return Finding(name, NEARLY, says)
    if exact:
        says = "is drawn otherwise than the accepted one, although its data and texts are the same"
        return Finding(name, DIFFERENT, says)
    return Finding(name, NEARLY, "belongs to the accepted data and texts; other versions drew it")


def _unlike(found: PDF, described: Described) -> str:
    """Return in words what a PDF and its description do not share."""
    if found.mark != described.fingerprint:
        return "was not written with its description: it is stale, or of another figure"
    if found.pages != 1:
        return f"has {found.pages} pages in place of 1"
    inches = tuple(described.content["size_in_inches"])
    if any(abs(a - b) > 1e-3 for a, b in zip(found.inches, inches, strict=True)):
        sizes = ["{:g} x {:g} inches".format(*size) for size in (found.inches, inches)]
        return " in place of ".join(sizes)
    if found.strokes < LEAST_STROKES:
        return "has an empty page"
    return ""
