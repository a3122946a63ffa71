"""Pages of HTML that hold their style, script and pictures, and ask no network."""

import base64
import struct
from pathlib import Path
from typing import NamedTuple

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

HERE = Path(__file__).parent
STUDIES = HERE.parents[1] / "studies"
"""Where the templates of the studies lie: the name of one is `paper/section.html.j2`, say."""

ASSETS = ("style.css", "script.js")
SIGNATURE = b"\x89PNG\r\n\x1a\n"
END = b"\0\0\0\0IEND\xaeB`\x82"


def render(template: str, folder: Path = STUDIES, **values) -> str:
    """Return the page of a template, which extends base.html.j2, filled with values.

    The template lies in `folder` or in this package. Text is escaped; a value that the template
    names and nobody gave is an error. The page asks no network: style and script stand in it.
    """
    environment = Environment(
        loader=FileSystemLoader([folder, HERE / "templates"]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    inlined = {name: Markup((HERE / name).read_text(encoding="utf-8")) for name in ASSETS}
    environment.globals |= {name.partition(".")[0]: text for name, text in inlined.items()}
    return environment.get_template(template).render(**values)


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
    """Return the PNG at `path` as an address that holds its bytes, with its size in pixels."""
    try:
        png = Path(path).read_bytes()
    except FileNotFoundError:
        raise PictureError(f"{path} is missing: run snakemake to make it") from None
    if not (png.startswith(SIGNATURE) and png.endswith(END)):
        raise PictureError(f"{path} is no whole PNG: delete it and run snakemake to make it again")
    width, height = struct.unpack(">II", png[16:24])
    return Picture(address_of(png), width, height, alt, link)


def address_of(png: bytes) -> str:
    """Return the address that holds a PNG itself, for a page that asks no network."""
    return f"data:image/png;base64,{base64.b64encode(png).decode()}"
