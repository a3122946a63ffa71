"""Compares a PNG with that of the baseline, by the strictest Method that the circumstances allow.

The form of a file (its kind of pixels, frames and dots per inch) is exact by every method. The
description beside a picture tells its texts and colours (`compare_description`). This module
compares the pixels, because a fault can show in them alone.
"""

import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from enum import Enum
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from PIL import Image

from . import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding, Motion
from .compare_description import DamagedDescriptionError, read_description


class Method(Enum):
    """How two pictures are compared."""

    PIXELS = "every pixel is the accepted one"
    """Where the same versions draw the same data: processors do not change any pixel."""

    LOOK = "every part looks alike"
    """Where other versions draw text a little differently, or data moved by less than one sees.

    Both images are averaged over 4 by 4 pixels (75 dots per inch, which is what an eye sees of a
    page) and blurred, which removes hinting. Then the ink and the colours around each point that
    the two do not share are divided by all ink and colours there (the Bray-Curtis distance: 0 same,
    1 nothing in common), and the smallest value over all shifts by up to 8 pixels counts. A lost
    label or a swapped colour differs at any shift, and by all of its own ink, however small it is
    in the whole image."""

    INK = "every panel holds as much ink"
    """Where curves moved visibly, within what chaos allows.

    An image is divided along the edges of its panels, which its file names. A chaotic curve that
    takes another path leaves as much ink in its panel, and an axis with a few other ticks as much
    beside it. A lost label, curve or panel leaves less."""


def method(motion: Motion, same_environment: bool) -> Method:
    """Return how to compare a picture of data that moved so far, with that of the baseline."""
    if motion is Motion.SEEN:
        return Method.INK
    return Method.PIXELS if same_environment and motion is Motion.NONE else Method.LOOK


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

PANELS, MARK = FOLLOWING = ("Panels", "Description")
"""What a PNG says of itself that follows the data: its panels, and the mark of its description."""

Box = tuple[int, int, int, int]
"""Left, top, right, bottom of a panel, in pixels."""


UNREADABLE = (OSError, SyntaxError, ValueError)
"""What Pillow raises of a damaged file."""


class DamagedImageError(ValueError):
    """An image that cannot be read; the message says why, and the finding names the file."""


class Picture(NamedTuple):
    """What is compared of a PNG."""

    colours: np.ndarray
    """(height, width, 3), from 0 to 255, as one sees them on white paper."""
    panels: list[Box]
    """The panels that the file names."""
    form: dict[str, Any]
    """What a file says of its pixels as a whole, in the words of a finding."""


def read(path: Path) -> Picture:
    """Read a PNG completely, so that damage shows here."""
    with _opened(path) as image:
        about = {key: said for key, said in image.info.items() if key not in FOLLOWING}
        form = {"kind of pixels": image.mode, "frames": getattr(image, "n_frames", 1), **about}
        layers = np.asarray(image.convert("RGBA"))
        panels = image.info.get(PANELS, "")
    boxes = [tuple(int(number) for number in box.split()) for box in panels.split(";") if box]
    form["least opacity"] = int(layers[..., 3].min(initial=255))
    return Picture(_on_white(layers), boxes, form)


def _mark(path: Path) -> str:
    """Return the fingerprint of the description with which a PNG was written."""
    with _opened(path) as image:
        return image.info.get(MARK, "")


@contextmanager
def _opened(path: Path) -> Iterator[Image.Image]:
    try:
        with Image.open(path) as image:
            yield image
    except UNREADABLE as error:
        said = str(error).replace(str(path), path.name)  # the page is no place for folders
        raise DamagedImageError(f"cannot be read ({said})") from None


def _on_white(layers: np.ndarray) -> np.ndarray:
    """Return what one sees of colours and their opacity (height, width, 4)."""
    opacity = layers[..., 3:]
    if (opacity == 255).all():
        return layers[..., :3]
    share = opacity / 255
    return np.round(layers[..., :3] * share + 255 * (1 - share)).astype(np.uint8)


def compare(name: str, reference: Path, new: Path, description: Path, by: Method) -> Finding:
    """Return the finding for the PNG `new`, which must carry the mark of its `description`."""
    try:
        if _mark(new) != read_description(description).fingerprint:
            says = "was not written with its description: it is stale, or of another figure"
            return Finding(name, DIFFERENT, says)
        if reference.read_bytes() == new.read_bytes():
            return Finding(name, IDENTICAL)
        return judge(name, read(reference), read(new), by)
    except (DamagedImageError, DamagedDescriptionError) as error:
        return Finding(name, DAMAGED, f"the picture {error}")


def judge(name: str, was: Picture, now: Picture, by: Method) -> Finding:
    """Return the finding for two pictures by one method."""
    if was.colours.shape != now.colours.shape:
        sizes = [f"{p.colours.shape[1]} x {p.colours.shape[0]} pixels" for p in (now, was)]
        return Finding(name, DIFFERENT, " in place of ".join(sizes))
    for key in {**was.form, **now.form}:
        pair = [each.form.get(key, "absent") for each in (now, was)]
        if pair[0] != pair[1]:
            return Finding(name, DIFFERENT, f"{key} is {pair[0]} in place of {pair[1]}")
    if np.array_equal(was.colours, now.colours):
        return Finding(name, IDENTICAL)
    if by is Method.INK:
        return Finding(name, *_by_ink(was, now))
    compared = _by_pixels if by is Method.PIXELS else _by_look
    return Finding(name, *compared(was.colours, now.colours))


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


def _by_ink(was: Picture, now: Picture) -> tuple[str, str]:
    change, says = _change_of_ink(was, now)
    # The legend and the titles above the panels do not depend on the curves; the topmost tick does.
    head = min((box[1] for box in was.panels), default=0) - HALF_LETTER
    if head > LOOK_REDUCED and _by_look(was.colours[:head], now.colours[:head])[0] == DIFFERENT:
        return DIFFERENT, "what stands above the panels looks different"
    status = DIFFERENT if change > MOST_INK else NEARLY
    return status, f"{says} ({MOST_INK:.0%} is allowed)"


def _change_of_ink(reference: Picture, new: Picture) -> tuple[float, str]:
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


def _ink_in_cells(image: Picture) -> np.ndarray:
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
