"""Compares pictures with the accepted ones, and with the descriptions beside them.

A picture carries the fingerprint of its description (`latticode.drawing.description`), and that the
digest of the data: so one of other data, an older run or another figure is told on any machine. It
carries a digest of what it shows too, so that an edited one is told. With other bytes it is a fault
where the accepted versions drew it. Elsewhere its pixels are compared coarsely.
"""

import json
import re
import zlib
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from latticode.datasets.digest import fingerprint
from latticode.drawing.seals import is_sealed
from PIL import Image

from . import Status

BLOCKS = 24, 16
TINTED, INKED = 1.2, 6.0
"""How far reds less blues of all blocks may differ, as a part of their sum: they do by twice this
sum where red and blue are exchanged. And the mean shade of a block on which something is drawn."""

STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
SHOWN_TEXT = re.compile(rb"\bBT\b(.*?)\bET\b", re.DOTALL)
IN_BRACKETS = re.compile(rb"\(((?:\\.|[^\\()])*)\)", re.DOTALL)
ESCAPED = re.compile(rb"\\(?:\d{3}|.)", re.DOTALL)
"""Streams of a PDF, the parts of one that show text, texts there, and letters by their numbers."""

WORDS, TEX = ("text", "title", "label", "ticks"), re.compile(r"\\[a-zA-Z]+|[${}\\^_ ]")
"""Entries of a description whose words a reader sees, and what is not a letter in them."""

NAMED_IN_A_LEGEND = ("curves", "areas", "images", "shapes")

MARK = re.compile(rb"(?:Description\0|/Keywords \()([0-9a-f]{64})")
"""Where a PNG and a PDF carry the fingerprint of their description."""


def compare_picture(
    new: Path, accepted_copy: Path, same_bytes: bool, described: Status
) -> tuple[Status, str]:
    """Return status and reason of a PNG or a PDF; `described` is the status of its description."""
    content, text = new.read_bytes(), new.with_suffix(".json")
    if fault := damage(new, content) or edited(new, content):
        return Status.DAMAGED, fault
    mark = MARK.search(content)
    if not (mark and text.exists() and mark[1].decode() == fingerprint(text.read_text("utf-8"))):
        stale = "was not written with its description: it is stale, or of another figure"
        return Status.DIFFERENT, stale
    if same_bytes:
        return Status.IDENTICAL, ""
    if described.is_fault:
        return Status.DIFFERENT, "shows what its description says, which is a fault"
    if new.suffix == ".pdf" and letters_in(content) < 0.5 * letters_of(
        json.loads(text.read_text())
    ):
        return Status.DIFFERENT, "has lost text that its description names"
    if new.suffix == ".png" and (
        fault := _unlike(accepted_copy, new, described == Status.IDENTICAL)
    ):
        return Status.DIFFERENT, f"{fault} the accepted picture"
    return Status.BEYOND, f"other bytes, which belong to its description; that is {described}"


def _unlike(accepted_copy: Path, new: Path, same_description: bool) -> str:
    """Return in words how two pictures differ in a few large blocks, or an empty text.

    Other versions change the mean shade by up to 3 of 255, other chaotic curves by 2, other figures
    by 8. What is redder and what is bluer stays so: by up to 0.33 of their sum in other versions,
    and 0.62 for other chaotic curves. No block loses all of its ink where the same is described.
    """
    with Image.open(accepted_copy) as was, Image.open(new) as now:
        size_difference = np.subtract(was.size, now.size)
        old, new_blocks = (
            np.asarray(image.convert("RGB").resize(BLOCKS, Image.Resampling.BOX), float)
            for image in (was, now)
        )
    if abs(size_difference).max() > 4 or abs(new_blocks - old).mean() >= 7.5:
        return "looks otherwise than"
    tints, inks = [
        [blocks[..., 0] - blocks[..., 2] for blocks in (old, new_blocks)],
        [255.0 - blocks.mean(axis=-1) for blocks in (old, new_blocks)],
    ]
    if abs(tints[1] - tints[0]).sum() > TINTED * max(abs(tints[0]).sum(), tints[0].size):
        return "has other colours than"
    if same_description and ((inks[0] > INKED) & (inks[1] < 0.1 * inks[0])).any():
        return "shows nothing at a place where something is in"
    return ""


def letters_in(pdf: bytes) -> int:
    """Return how many bytes of text a PDF shows: one or two for a letter."""
    count = 0
    for stream in STREAM.findall(pdf):
        with suppress(zlib.error):
            texts = b"".join(SHOWN_TEXT.findall(zlib.decompress(stream)))
            count += sum(len(ESCAPED.sub(b"x", letters)) for letters in IN_BRACKETS.findall(texts))
    return count


def letters_of(description: Any, key: str = "") -> int:
    """Return how many letters the words of a description have, without commands of TeX."""
    if isinstance(description, dict):
        described = {
            name: entry for name, entry in description.items() if name not in NAMED_IN_A_LEGEND
        }
        return sum(letters_of(entry, name) for name, entry in described.items())
    if isinstance(description, list):
        return sum(letters_of(entry, key) for entry in description)
    return len(TEX.sub("", description)) if key in WORDS else 0


def damage(path: Path, content: bytes) -> str:
    """Return in words why a picture or a PDF is not whole, or nothing."""
    if path.suffix == ".pdf":
        is_complete = content.startswith(b"%PDF-") and content.rstrip().endswith(b"%%EOF")
        return "" if is_complete else "is no whole PDF"
    try:
        Image.open(BytesIO(content)).verify()  # checksums, at which `load` does not look
        Image.open(BytesIO(content)).load()
    except (OSError, SyntaxError, ValueError):
        return "is no whole PNG"
    return ""


def edited(path: Path, content: bytes) -> str:
    """Return in words that a whole picture of a figure is not as it was drawn, or nothing."""
    return "" if is_sealed(path.suffix, content) else "was edited since it was drawn"
