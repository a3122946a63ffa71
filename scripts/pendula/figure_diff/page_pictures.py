"""Pictures for the page of the comparison, as addresses that hold the pictures themselves."""

import base64
import io
from pathlib import Path

import numpy as np
from PIL import Image

from . import pictures

THUMBNAIL = 320
"""Width in pixels of pictures that are identical; the others are shown whole."""


def embedded(path: Path) -> str:
    """Return the picture as an address that holds it, or nothing."""
    return _address(path.read_bytes()) if _pixels(path) is not None else ""


def _pixels(path: Path) -> np.ndarray | None:
    try:
        return pictures.read(path).pixels
    except pictures.PictureError:
        return None


def difference(reference: Path, new: Path) -> str:
    """Return, at half the size, what both share in grey, what went in red, what came in blue."""
    was, now = _pixels(reference), _pixels(new)
    if was is None or now is None or was.shape != now.shape:
        return ""
    was, now = (np.asarray(Image.fromarray(p).reduce(2), np.int16) for p in (was, now))
    old, new = (255 - pixels.min(-1) for pixels in (was, now))
    apart = abs(was - now).max(-1)
    shared = 255 - np.minimum(old, new) // 3
    went, came = apart * (old >= new), apart * (new > old)
    layers = [shared - came, shared - came - went, shared - went]
    return _png(np.stack(layers, -1).clip(0, 255).astype(np.uint8))


def thumbnail(path: Path) -> str:
    """Return a small copy of the picture."""
    image = Image.fromarray(pictures.read(path).pixels)
    image.thumbnail((THUMBNAIL, THUMBNAIL), reducing_gap=2)
    return _png(np.asarray(image))


def _png(pixels: np.ndarray) -> str:
    kept = io.BytesIO()
    Image.fromarray(pixels).save(kept, "png", compress_level=3)
    return _address(kept.getvalue())


def _address(png: bytes) -> str:
    """Return the address of a picture that holds the picture itself."""
    return f"data:image/png;base64,{base64.b64encode(png).decode()}"
