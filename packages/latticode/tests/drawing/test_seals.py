"""Seals of pictures: what is drawn is whole, and what was edited is not."""

from io import BytesIO

import numpy as np
from latticode.drawing.seals import PIXELS, digest_of_pixels, is_sealed, sealed_pdf
from PIL import Image
from PIL.PngImagePlugin import PngInfo


def png(pixels: np.ndarray, seal: str) -> bytes:
    texts = PngInfo()
    texts.add_text(PIXELS, seal)
    with BytesIO() as file:
        Image.fromarray(pixels).save(file, "png", pnginfo=texts)
        return file.getvalue()


def test_a_png_with_another_pixel_or_without_a_seal_is_not_whole():
    pixels = np.random.default_rng(1).integers(0, 256, (5, 7, 4), dtype=np.uint8)
    seal = digest_of_pixels(pixels)
    assert is_sealed(".png", png(pixels, seal))
    edited = pixels.copy()
    edited[2, 3, 0] ^= 1
    assert not is_sealed(".png", png(edited, seal)) and not is_sealed(".png", png(pixels, ""))


def test_a_pdf_with_another_byte_or_without_a_seal_is_not_whole():
    content = b"%PDF-1.4\n1 0 obj\nendobj\n%%EOF\n"
    sealed = sealed_pdf(content)
    assert is_sealed(".pdf", sealed) and sealed.endswith(b"%%EOF\n")
    assert not is_sealed(".pdf", sealed.replace(b"1 0", b"2 0")) and not is_sealed(".pdf", content)
