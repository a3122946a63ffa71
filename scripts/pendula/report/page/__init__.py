"""Pages of HTML that hold their style, script and pictures, and ask no network."""

import base64
import io
from pathlib import Path
from typing import NamedTuple

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from PIL import Image

HERE = Path(__file__).parent

ASSETS = ("style.css", "script.js")
COLOURS = 256
"""A page shows a picture in so many colours, with a third of the bytes that its file has."""


def render(template: str, folder: Path = HERE, **values) -> str:
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

    @property
    def name(self) -> str:
        """A name for its place on the page, such as fig5 for figures/fig5.png."""
        return self.link.removeprefix("figures/").removesuffix(".png").replace("/", "-")


def picture(path: str | Path, alt: str, link: str) -> Picture:
    """Return the PNG at `path` as an address that holds its pixels in COLOURS colours."""
    shown = io.BytesIO()
    try:
        with Image.open(path) as image:
            few = image.convert("RGB").quantize(
                COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE
            )
    except FileNotFoundError:
        raise PictureError(f"{path} is missing: run snakemake to make it") from None
    except (OSError, SyntaxError):  # Pillow raises either for a damaged file
        raise PictureError(
            f"{path} is not a complete PNG: delete it and run snakemake to make it again"
        ) from None
    few.save(shown, "PNG")
    address = f"data:image/png;base64,{base64.b64encode(shown.getvalue()).decode()}"
    return Picture(address, *few.size, alt, link)
