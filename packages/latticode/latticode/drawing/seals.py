"""What a picture says of its own content, so that one that was edited is recognised.

A PNG keeps a digest of its pixels among its texts. A PDF ends with a comment that holds a digest of
all bytes before it.
"""

import re
from hashlib import sha256
from io import BytesIO

import numpy as np
from PIL import Image

PIXELS = "Pixels"
"""The name of the text of a PNG that holds the digest."""
COMMENT = b"%% SHA-256 of all bytes before this line: %b\n%%%%EOF\n"
SEALED = re.compile(rb"(.*)" + COMMENT % rb"([0-9a-f]{64})" + rb"\Z", re.DOTALL)


def digest_of_pixels(pixels: np.ndarray) -> str:
    """Return the SHA-256 of the size of a picture, (height, width, 4), and of its pixels."""
    height, width = pixels.shape[:2]
    return sha256(f"{width} x {height}\n".encode() + pixels.tobytes()).hexdigest()


def sealed_pdf(content: bytes) -> bytes:
    """Return a PDF with the comment at its end; readers of PDF pass it over."""
    return content + COMMENT % sha256(content).hexdigest().encode()


def is_sealed(kind: str, content: bytes) -> bool:
    """Return whether a whole picture, ".png" or ".pdf", is as it was drawn."""
    if kind == ".pdf":
        match = SEALED.fullmatch(content)
        return match is not None and sha256(match[1]).hexdigest().encode() == match[2]
    with Image.open(BytesIO(content)) as image:
        pixels = np.asarray(image.convert("RGBA"))
        return image.text.get(PIXELS) == digest_of_pixels(pixels)
