"""PNG files as arrays, with the boxes of their panels."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image

Box = tuple[int, int, int, int]
"""Left, top, right, bottom of a panel, in pixels."""


class PictureError(ValueError):
    """A picture that cannot be read."""


class Picture(NamedTuple):
    """Pixels, height by width by red, green, blue, and the panels named in the file."""

    pixels: np.ndarray
    panels: list[Box]


def read(path: Path) -> Picture:
    """Read a picture whole, so that a damaged one is found out here."""
    try:
        with Image.open(path) as image:
            pixels = np.asarray(image.convert("RGB"))
            panels = image.info.get("Panels", "")
    except (OSError, SyntaxError, ValueError) as error:
        said = str(error).replace(str(path), path.name)  # the page is no place for folders
        raise PictureError(f"cannot be read ({said})") from None
    boxes = [tuple(int(number) for number in box.split()) for box in panels.split(";") if box]
    return Picture(pixels, boxes)


def inks(pixels: np.ndarray, factor: int) -> np.ndarray:
    """Return darkness and two colour contrasts, each 0 on white, averaged over small squares.

    Contrasts are zero on grey, so that text drawn otherwise changes darkness alone.
    """
    reduced = np.asarray(Image.fromarray(pixels).reduce(factor), np.float32) / 255
    red, green, blue = np.moveaxis(reduced, -1, 0)
    return np.stack([1 - (red + green + blue) / 3, red - green, green - blue])
