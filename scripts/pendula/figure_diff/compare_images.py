"""Compares an image with that of the baseline by one of three methods.

- By pixels, where the environment that drew the image is that of the baseline, and the data have
  the accepted bits: then every pixel must be the accepted one. Processors do not change any.
- By look in other environments, where text may be drawn a little differently. Both images are
  averaged over 4 by 4 pixels (75 dots per inch, which is what an eye sees of a page) and blurred,
  which removes hinting. Then the ink and the colours around each point that the two do not share
  are divided by all ink and colours there (the Bray-Curtis distance: 0 same, 1 nothing in common),
  and the smallest value over all shifts by up to 8 pixels counts. A lost label or a swapped colour
  differs at any shift, and by all of its own ink, however small it is in the whole image.
- By ink, where the curves are known to have moved. An image is divided along the edges of its
  panels, which its file names. A chaotic curve that takes another path leaves as much ink in its
  panel, and an axis with a few other ticks as much beside it. A lost label, curve or panel leaves
  less.
"""

import itertools
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

from . import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding
from .compare_description import DamagedDescriptionError, read_description

EXACT, LOOK = "exact", "look"

MOST_UNLIKE = 0.35
"""The local distance that is allowed in another environment: other letters and shifts by a pixel
reach 0.26 in the figures of this project, a lost label or swapped colours 0.9."""
MOST_INK = 0.5
"""The relative change of ink in a cell that is allowed where curves have moved. The reason: whole
reproductions from data that differ by 1e-15 changed 0.40 of a strip of a chaotic curve, and 0.37 of
a cell that holds one tick; swapped colours change 0.9. Lost labels and curves are found by the
description, whatever their ink."""

LOOK_REDUCED, BLUR, SHIFT = 4, 1.0, 2
NEIGHBOURHOOD = 9
"""About the height of a letter and of its surroundings, 36 pixels."""
FAINT = np.array([0.02, 0.03])
"""Darkness and colour that count as nothing: a speck is not a label."""
HALF_LETTER = 20

INK_REDUCED = 2
NEAR = 15
"""Edges of panels that are closer than so many pixels count as one edge."""
LEAST_INK = 250.0 / INK_REDUCED**2
"""Ink of a cell that counts as nothing: of 250 black pixels, one small letter or a tick or two."""

Box = tuple[int, int, int, int]
"""Left, top, right, bottom of a panel, in pixels."""


UNREADABLE = (OSError, SyntaxError, ValueError)
"""What Pillow raises of a damaged file."""


class DamagedImageError(ValueError):
    """An image that cannot be read; the message says why, and the finding names the file."""


class Pixels(NamedTuple):
    """Colours (height, width, 3) from 0 to 255, and the panels that the file names."""

    colours: np.ndarray
    panels: list[Box]


def read(path: Path) -> Pixels:
    """Read a PNG completely, so that damage shows here."""
    try:
        with Image.open(path) as image:
            colours = np.asarray(image.convert("RGB"))
            panels = image.info.get("Panels", "")
    except UNREADABLE as error:
        raise DamagedImageError(_say(path, error)) from None
    boxes = [tuple(int(number) for number in box.split()) for box in panels.split(";") if box]
    return Pixels(colours, boxes)


def _mark(path: Path) -> str:
    """Return the fingerprint of the description with which a PNG was written."""
    try:
        with Image.open(path) as image:
            return image.info.get("Description", "")
    except UNREADABLE as error:
        raise DamagedImageError(_say(path, error)) from None


def _say(path: Path, error: Exception) -> str:
    said = str(error).replace(str(path), path.name)  # the page is no place for folders
    return f"cannot be read ({said})"


def compare(
    name: str, reference: Path, new: Path, method: str, moved: bool, description: Path
) -> Finding:
    """Return the finding for an image; `moved` says that the curves in it are known to have moved.

    `method` is EXACT where the environment and the bits of the data are those of the baseline, and
    LOOK elsewhere. `description` is that of the new image, which must carry its fingerprint.
    """
    try:
        if _mark(new) != read_description(description).fingerprint:
            says = "was not written with its description: it is stale, or of another figure"
            return Finding(name, DIFFERENT, says)
        if reference.read_bytes() == new.read_bytes():
            return Finding(name, IDENTICAL)
        return judge(name, read(reference), read(new), method, moved)
    except (DamagedImageError, DamagedDescriptionError) as error:
        return Finding(name, DAMAGED, f"the picture {error}")


def judge(name: str, was: Pixels, now: Pixels, method: str, moved: bool) -> Finding:
    """Return the finding by the strictest method that the circumstances allow."""
    if was.colours.shape != now.colours.shape:
        sizes = [f"{p.colours.shape[1]} x {p.colours.shape[0]} pixels" for p in (now, was)]
        return Finding(name, DIFFERENT, " in place of ".join(sizes))
    if np.array_equal(was.colours, now.colours):
        return Finding(name, IDENTICAL)
    if moved:
        return Finding(name, *_by_ink(was, now))
    by_method = {EXACT: _by_pixels, LOOK: _by_look}[method]
    return Finding(name, *by_method(was.colours, now.colours))


def _by_pixels(was: np.ndarray, now: np.ndarray) -> tuple[str, str]:
    unlike = (was != now).any(-1)
    return DIFFERENT, f"{unlike.sum()} pixels differ, in {_where(unlike)}"


def _where(mask: np.ndarray, scale: int = 1) -> str:
    """Return in words the box around all that differs."""
    rows, columns = (np.flatnonzero(mask.any(axis)) * scale for axis in (1, 0))
    return f"x {columns[0]}-{columns[-1]}, y {rows[0]}-{rows[-1]}"


def _by_look(was: np.ndarray, now: np.ndarray) -> tuple[str, str]:
    apart = local_distance(was, now)
    status = DIFFERENT if apart.max() > MOST_UNLIKE else NEARLY
    where = _where(apart >= min(MOST_UNLIKE, apart.max()), LOOK_REDUCED)
    return status, f"looks unlike by up to {apart.max():.2f} (allowed {MOST_UNLIKE}), in {where}"


def local_distance(reference: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Return the distance of two images, one value for each square of 4 by 4 pixels."""
    was, now = _blurred(reference), _blurred(new)
    present = [_around(abs(channels)) for channels in (was, now)]
    best = np.full(was.shape[1:], np.inf, np.float32)
    for shift in itertools.product(range(-SHIFT, SHIFT + 1), repeat=2):
        shifted, there = (np.roll(array, shift, (1, 2)) for array in (now, present[1]))
        apart = _around(abs(was - shifted)) / (present[0] + there + FAINT[:, None, None])
        np.minimum(best, apart.max(0), out=best)
    return best[SHIFT:-SHIFT, SHIFT:-SHIFT]


def _blurred(colours: np.ndarray) -> np.ndarray:
    from scipy.ndimage import gaussian_filter  # here, for most comparisons do without its 0.4 s

    margins = [(0, 0), (SHIFT, SHIFT), (SHIFT, SHIFT)]
    channels = np.pad(_inks(colours, LOOK_REDUCED), margins)
    return gaussian_filter(channels, (0, BLUR, BLUR))


def _around(channels: np.ndarray) -> np.ndarray:
    """Return the means of darkness, and of both contrasts together, around each point."""
    from scipy.ndimage import uniform_filter

    both = np.stack([channels[0], channels[1] + channels[2]])
    return uniform_filter(both, (0, NEIGHBOURHOOD, NEIGHBOURHOOD), mode="constant")


def _inks(colours: np.ndarray, factor: int) -> np.ndarray:
    """Return darkness and two colour contrasts, each 0 on white, averaged over small squares.

    The contrasts are zero on grey, so that text drawn differently changes the darkness alone.
    """
    reduced = np.asarray(Image.fromarray(colours).reduce(factor), np.float32) / 255
    red, green, blue = np.moveaxis(reduced, -1, 0)
    return np.stack([1 - (red + green + blue) / 3, red - green, green - blue])


def _by_ink(was: Pixels, now: Pixels) -> tuple[str, str]:
    change, says = _change_of_ink(was, now)
    # The legend and the titles above the panels do not depend on the curves; the topmost tick does.
    head = min((box[1] for box in was.panels), default=0) - HALF_LETTER
    if head > LOOK_REDUCED and _by_look(was.colours[:head], now.colours[:head])[0] == DIFFERENT:
        return DIFFERENT, "what stands above the panels looks different"
    status = DIFFERENT if change > MOST_INK else NEARLY
    return status, f"{says} ({MOST_INK:.0%} is allowed)"


def _change_of_ink(reference: Pixels, new: Pixels) -> tuple[float, str]:
    """Return the largest relative change of ink in a cell, and in words where it is."""
    if len(reference.panels) != len(new.panels):
        return np.inf, f"has {len(new.panels)} panels in place of {len(reference.panels)}"
    was, now = (_ink_in_cells(image) for image in (reference, new))
    if was.shape != now.shape:
        return np.inf, "has its panels arranged otherwise"
    relative = (abs(was - now) / (np.maximum(was, now) + LEAST_INK)).max(0)
    row, column = np.unravel_index(relative.argmax(), relative.shape)
    place = f"in part {row + 1} from above, {column + 1} from the left"
    return float(relative.max()), f"{relative.max():.0%} of the ink changed {place}"


def _ink_in_cells(image: Pixels) -> np.ndarray:
    """Return the ink in each cell: the darkness, and each contrast of either sign."""
    height, width = image.colours.shape[:2]
    rows = _edges([edge for box in image.panels for edge in (box[1], box[3])], height)
    columns = _edges([edge for box in image.panels for edge in (box[0], box[2])], width)
    dark, warm, cold = _inks(image.colours, INK_REDUCED)
    signed = [part.clip(0) for contrast in (warm, cold) for part in (contrast, -contrast)]
    kinds = np.stack([dark, *signed])
    return np.add.reduceat(np.add.reduceat(kinds, rows, axis=1), columns, axis=2)


def _edges(edges: list[int], size: int) -> list[int]:
    """Return where cells begin, in reduced pixels; of edges close together the first one counts."""
    edges = sorted({0, size, *(min(max(edge, 0), size) for edge in edges)})
    kept = [0, *(b for a, b in itertools.pairwise(edges) if b - a >= NEAR)]
    return [edge // INK_REDUCED for edge in kept if edge < size]
