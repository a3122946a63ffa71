"""Checksums inside pictures, which reveal that a picture was edited.

A PNG has the SHA-256 of its pixels in a text chunk. A PDF ends with a comment that has the SHA-256
of all bytes before it.
"""

import re
from hashlib import sha256
from io import BytesIO

import numpy as np
from PIL import Image

PIXELS = "Pixels"
"""Key of the checksum among the texts of a PNG."""
COMMENT = b"%% SHA-256 of all bytes before this line: %b\n%%%%EOF\n"
SEALED = re.compile(rb"(.*)" + COMMENT % rb"([0-9a-f]{64})" + rb"\Z", re.DOTALL)


def digest_of_pixels(pixels: np.ndarray) -> str:
    """Return the SHA-256 of the size and the pixels (height, width, 4) of a picture."""
    height, width = pixels.shape[:2]
    return sha256(f"{width} x {height}\n".encode() + pixels.tobytes()).hexdigest()


def sealed_pdf(content: bytes) -> bytes:
    """Return a PDF with the comment appended; PDF viewers ignore it."""
    return content + COMMENT % sha256(content).hexdigest().encode()


def is_sealed(kind: str, content: bytes) -> bool:
    """Return whether the checksum of a picture matches; `kind` is ".png" or ".pdf"."""
    if kind == ".pdf":
        match = SEALED.fullmatch(content)
        return match is not None and sha256(match[1]).hexdigest().encode() == match[2]
    with Image.open(BytesIO(content)) as image:
        pixels = np.asarray(image.convert("RGBA"))
        return image.text.get(PIXELS) == digest_of_pixels(pixels)
