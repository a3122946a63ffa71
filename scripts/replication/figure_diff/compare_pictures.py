"""Compares pictures with the accepted ones, and with their descriptions in the same folder.

A picture contains the fingerprint of its description (`latticode.drawing.description`), and the
description contains the digest of its data. So a picture of other data is detected on any machine.
A digest of the picture's own content reveals edits. With the accepted package versions the picture
must have the accepted bytes (see `baseline`). With other versions its pixels are compared coarsely.
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
"""Allowed difference of red minus blue between two pictures, relative to red minus blue; exchanged
colours give 2. Darkness above which something is drawn on a block."""

STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
SHOWN_TEXT = re.compile(rb"\bBT\b(.*?)\bET\b", re.DOTALL)
IN_BRACKETS = re.compile(rb"\(((?:\\.|[^\\()])*)\)", re.DOTALL)
ESCAPED = re.compile(rb"\\(?:\d{3}|.)", re.DOTALL)
"""The streams of a PDF, the parts of a stream that show text, their texts, and escaped letters."""

WORDS, TEX = ("text", "title", "label", "ticks"), re.compile(r"\\[a-zA-Z]+|[${}\\^_ ]")
"""Entries of a description that are printed in the figure; TeX commands in these entries."""

NAMED_IN_A_LEGEND = ("curves", "areas", "images", "shapes")

MARK = re.compile(rb"(?:Description\0|/Keywords \()([0-9a-f]{64})")
"""The fingerprint of the description in a PNG or a PDF."""


def compare_picture(
    new: Path, accepted_copy: Path, same_bytes: bool, described: Status
) -> tuple[Status, str]:
    """Return status and reason of a PNG or a PDF; `described` is the status of its description."""
    content, text = new.read_bytes(), new.with_suffix(".json")
    if fault := damage(new, content) or edited(new, content):
        return Status.DAMAGED, fault
    mark = MARK.search(content)
    if not (mark and text.exists() and mark[1].decode() == fingerprint(text.read_text("utf-8"))):
        stale = "does not belong to its description: it is stale, or of another figure"
        return Status.DIFFERENT, stale
    if same_bytes:
        return Status.IDENTICAL, ""
    if described.is_fault:
        return Status.DIFFERENT, f"its description is {described}"
    if new.suffix == ".pdf" and letters_in(content) < 0.5 * letters_of(
        json.loads(text.read_text())
    ):
        return Status.DIFFERENT, "lacks text that its description lists"
    if new.suffix == ".png" and (
        fault := _unlike(accepted_copy, new, described == Status.IDENTICAL)
    ):
        return Status.DIFFERENT, f"{fault} the accepted picture"
    return Status.BEYOND, f"its bytes differ; its description is {described}"


def _unlike(accepted_copy: Path, new: Path, same_description: bool) -> str:
    """Return how two pictures differ in their mean colours over large blocks, or an empty text.

    On a scale of 255 the mean shade differs by up to 3 with other package versions, by 2 if chaotic
    curves differ, and by 8 for another figure. The relative difference of red minus blue is up to
    0.33 with other versions and 0.62 if chaotic curves differ. With the same description no block
    becomes empty.
    """
    with Image.open(accepted_copy) as was, Image.open(new) as now:
        size_difference = np.subtract(was.size, now.size)
        old, new_blocks = (
            np.asarray(image.convert("RGB").resize(BLOCKS, Image.Resampling.BOX), float)
            for image in (was, now)
        )
    if abs(size_difference).max() > 4 or abs(new_blocks - old).mean() >= 7.5:
        return "looks different from"
    tints, inks = [
        [blocks[..., 0] - blocks[..., 2] for blocks in (old, new_blocks)],
        [255.0 - blocks.mean(axis=-1) for blocks in (old, new_blocks)],
    ]
    if abs(tints[1] - tints[0]).sum() > TINTED * max(abs(tints[0]).sum(), tints[0].size):
        return "differs in colours from"
    if same_description and ((inks[0] > INKED) & (inks[1] < 0.1 * inks[0])).any():
        return "is empty at a place where something is drawn in"
    return ""


def letters_in(pdf: bytes) -> int:
    """Return how many bytes of text a PDF shows: one or two per letter."""
    count = 0
    for stream in STREAM.findall(pdf):
        with suppress(zlib.error):
            texts = b"".join(SHOWN_TEXT.findall(zlib.decompress(stream)))
            count += sum(len(ESCAPED.sub(b"x", letters)) for letters in IN_BRACKETS.findall(texts))
    return count


def letters_of(description: Any, key: str = "") -> int:
    """Return the number of letters of the printed texts in a description, without TeX commands."""
    if isinstance(description, dict):
        described = {
            name: entry for name, entry in description.items() if name not in NAMED_IN_A_LEGEND
        }
        return sum(letters_of(entry, name) for name, entry in described.items())
    if isinstance(description, list):
        return sum(letters_of(entry, key) for entry in description)
    return len(TEX.sub("", description)) if key in WORDS else 0


def damage(path: Path, content: bytes) -> str:
    """Return a message if a PNG or PDF is incomplete, else an empty text."""
    if path.suffix == ".pdf":
        is_complete = content.startswith(b"%PDF-") and content.rstrip().endswith(b"%%EOF")
        return "" if is_complete else "is not a complete PDF"
    try:
        Image.open(BytesIO(content)).verify()  # checks checksums, unlike `load`
        Image.open(BytesIO(content)).load()
    except (OSError, SyntaxError, ValueError):
        return "is not a complete PNG"
    return ""


def edited(path: Path, content: bytes) -> str:
    """Return a message if a complete picture was edited, else an empty text."""
    return "" if is_sealed(path.suffix, content) else "was edited since it was drawn"
