"""The page of the comparison: it shows reference, new image and difference side by side."""

import io
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

from pendula.report import page
from pendula.report.page import address_of

from . import IDENTICAL, NEARLY, STATUSES, Finding
from .compare_images import DamagedImageError, read

THUMBNAIL = 320
"""Width in pixels of images that are identical; the others are shown whole."""


class Shown(NamedTuple):
    """An image on the page; the address is empty where there is nothing to show."""

    address: str
    caption: str


class Section(NamedTuple):
    """All findings of one status: those of datasets, and those of images with what is shown."""

    status: str
    datasets: list[Finding]
    images: list[tuple[Finding, list[Shown]]]
    is_open: bool


def render(findings: Sequence[Finding], made: Path, folder: Path, note: str) -> str:
    """Return the page; images are read from below `made` and from the baseline's folder."""
    return page.render(
        "comparison_page.html.j2",
        Path(__file__).parent,
        counts=Counter(finding.status for finding in findings),
        faults=sum(finding.is_fault for finding in findings),
        statuses=STATUSES,
        note=note,
        sections=[_section(status, findings, made, folder) for status in STATUSES],
    )


def _section(status: str, findings: Sequence[Finding], made: Path, folder: Path) -> Section:
    mine = [finding for finding in findings if finding.status == status]
    images = [finding for finding in mine if finding.name.endswith(".png")]
    return Section(
        status,
        [finding for finding in mine if finding not in images],
        [(finding, _shown(finding, made, folder)) for finding in images],
        is_open=status not in (IDENTICAL, NEARLY),
    )


def _shown(finding: Finding, made: Path, folder: Path) -> list[Shown]:
    """Return a thumbnail of an identical image; of any other, three images to compare."""
    new, reference = made / finding.name, folder / finding.name
    if finding.status == IDENTICAL:
        return [Shown(_thumbnail(new), finding.name)]
    return [
        Shown(_whole(reference), "reference"),
        Shown(_whole(new), "new"),
        Shown(_difference(reference, new), "difference (grey: same, red: gone, blue: new)"),
    ]


def _whole(path: Path) -> str:
    return address_of(path.read_bytes()) if _colours(path) is not None else ""


def _thumbnail(path: Path) -> str:
    image = Image.fromarray(read(path).colours)
    image.thumbnail((THUMBNAIL, THUMBNAIL), reducing_gap=2)
    return _address(image)


def _difference(reference: Path, new: Path) -> str:
    """Return at half the size what both share in grey, what is gone in red, what is new in blue."""
    was, now = _colours(reference), _colours(new)
    if was is None or now is None or was.shape != now.shape:
        return ""
    was, now = (np.asarray(Image.fromarray(p).reduce(2), np.int16) for p in (was, now))
    old, new = (255 - colours.min(-1) for colours in (was, now))
    apart = abs(was - now).max(-1)
    shared = 255 - np.minimum(old, new) // 3
    gone, came = apart * (old >= new), apart * (new > old)
    layers = [shared - came, shared - came - gone, shared - gone]
    return _address(Image.fromarray(np.stack(layers, -1).clip(0, 255).astype(np.uint8)))


def _colours(path: Path) -> np.ndarray | None:
    try:
        return read(path).colours
    except DamagedImageError:
        return None


def _address(image: Image.Image) -> str:
    written = io.BytesIO()
    image.save(written, "png", compress_level=3)
    return address_of(written.getvalue())
