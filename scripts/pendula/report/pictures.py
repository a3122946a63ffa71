"""Pictures as addresses that hold the pictures themselves."""

import base64
import struct
from pathlib import Path
from typing import NamedTuple

SIGNATURE = b"\x89PNG\r\n\x1a\n"


class PictureError(RuntimeError):
    """A picture that cannot be shown; the message names the file."""


class Picture(NamedTuple):
    """A picture as the templates show it; `link` is where its file is, seen from the page."""

    address: str
    width: int
    height: int
    alt: str
    link: str


def picture(path: str | Path, alt: str, link: str) -> Picture:
    """Return the PNG at `path`, its bytes as they are, with its size in pixels."""
    try:
        png = Path(path).read_bytes()
    except FileNotFoundError:
        raise PictureError(f"{path} is missing: run snakemake to make it") from None
    if not png.startswith(SIGNATURE) or len(png) < 24:
        raise PictureError(f"{path} is no PNG: delete it and run snakemake to make it again")
    width, height = struct.unpack(">II", png[16:24])
    return Picture(address_of(png), width, height, alt, link)


def address_of(png: bytes) -> str:
    """Return the address that holds a PNG itself, for a page that asks no network."""
    return f"data:image/png;base64,{base64.b64encode(png).decode()}"
