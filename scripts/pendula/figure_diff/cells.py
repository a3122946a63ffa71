"""Compare pictures whose curves have moved: how much ink of each colour each part of them holds.

A picture is cut along the edges of its panels, which its file names. A chaotic curve that takes
another path leaves as much ink in its panel, and an axis with a few other ticks as much beside it,
while a lost label, curve or panel leaves less.
"""

from itertools import pairwise

import numpy as np

from .pictures import Picture, inks

REDUCED = 2
NEAR = 15
"""Edges of panels closer than so many pixels are one cut."""
LEAST = 250.0 / REDUCED**2
"""Ink of a cell that counts as nothing: of 250 black pixels, one small letter or a tick or two."""


def changes(reference: Picture, new: Picture) -> tuple[float, str]:
    """Return the largest relative change of ink in a cell, and where it is."""
    if len(reference.panels) != len(new.panels):
        return np.inf, f"has {len(new.panels)} panels in place of {len(reference.panels)}"
    was, now = (_totals(picture) for picture in (reference, new))
    if was.shape != now.shape:
        return np.inf, "has its panels arranged otherwise"
    relative = (abs(was - now) / (np.maximum(was, now) + LEAST)).max(0)
    row, column = np.unravel_index(relative.argmax(), relative.shape)
    place = f"in part {row + 1} from above, {column + 1} from the left"
    return float(relative.max()), f"{relative.max():.0%} of the ink changed {place}"


def _totals(picture: Picture) -> np.ndarray:
    """Return the ink in each cell: darkness, and each contrast of either sign."""
    height, width = picture.pixels.shape[:2]
    rows = _cuts([edge for box in picture.panels for edge in (box[1], box[3])], height)
    columns = _cuts([edge for box in picture.panels for edge in (box[0], box[2])], width)
    dark, warm, cold = inks(picture.pixels, REDUCED)
    signed = [part.clip(0) for contrast in (warm, cold) for part in (contrast, -contrast)]
    kinds = np.stack([dark, *signed])
    return np.add.reduceat(np.add.reduceat(kinds, rows, axis=1), columns, axis=2)


def _cuts(edges: list[int], size: int) -> list[int]:
    edges = sorted({0, size, *(min(max(edge, 0), size) for edge in edges)})
    kept = [0, *(after for before, after in pairwise(edges) if after - before >= NEAR)]
    return [edge // REDUCED for edge in kept if edge < size]
