"""The HTML page of an article, with its cards, scripts and live figures."""

import base64
import re
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

from PIL import Image

from replication.report import page

from .cards import Card, functions_of

THIS_FOLDER = Path(__file__).parent
SCRIPT = "cards.js"
ANNOTATION = re.compile(r"<annotation .*?</annotation>")
"""The TeX in a formula; pages omit it, or screen readers would read it."""

PICTURE = re.compile(r'<img src="([^":]*\.png)"([^>]*)>')
COLOURS = 256
CARD = re.compile(r'class="card" id="((?:claim|data)_[^"]*)"')
FIGURE = re.compile(r'<figure id="(figure-\d+)">\s*<a href="([^"]*)\.png">')


class LiveParts(NamedTuple):
    """The parts for live figures: HTML below each figure (by its id), data, script and style."""

    below_figures: Mapping[str, str]
    data: str
    script: str
    style: str


def complete_page(
    html: str, folder: Path, cards: Iterable[Card], live: LiveParts | None = None
) -> str:
    """Complete a page of Pandoc with cards, scripts, live figures and the pictures in `folder`."""
    cards = list(cards)
    script = "".join(
        f"{{\n{text}}}\n"  # a block for each script, so that equal names do not clash
        for text in (
            (THIS_FOLDER / SCRIPT).read_text(encoding="utf-8"),
            live.script if live else "",
        )
    )
    for figure, below in live.below_figures.items() if live else ():
        html = re.sub(
            rf'(<figure id="{figure}">.*?</figure>)',
            lambda match, below=below: f"{match[1]}\n{below}",
            html,
            count=1,
            flags=re.DOTALL,
        )
    replacements = {
        "<!-- cards -->": page.render(
            "cards.html.j2", THIS_FOLDER, cards=cards, functions=functions_of(cards)
        ),
        "<!-- script -->": f"{live.data if live else ''}<script>{script}</script>",
        "/* style of live figures */": live.style if live else "",
        "(hash of the script)": page.digest(script),
    }
    html = ANNOTATION.sub("", html)
    pictures = [picture for picture, _ in PICTURE.findall(html)]
    with ThreadPoolExecutor() as pool:  # Pillow releases Python's lock
        images = dict(zip(pictures, pool.map(embed, map(folder.joinpath, pictures)), strict=True))
    html = PICTURE.sub(lambda picture: _enlargeable(images, *picture.groups()), html)
    for place, content in replacements.items():
        html = html.replace(place, content)
    return html


def places_of(page: Path) -> dict[str, str]:
    """Return addresses in the page of an article of claims, variables and figures.

    The keys are ids of the report. For figures the keys are the paths of their files.
    """
    html = page.read_text(encoding="utf-8")
    ids = {card: card for card in CARD.findall(html)}
    ids |= {picture: figure for figure, picture in FIGURE.findall(html)}
    return {name: f"{page.name}#{place}" for name, place in ids.items()}


def _enlargeable(images: Mapping[str, str], picture: str, attributes: str) -> str:
    """Return a picture with a link to its file, because browsers can zoom in the file."""
    return f'<a href="{picture}"><img src="{images[picture]}"{attributes}></a>'


def embed(picture: Path) -> str:
    """Return a picture as a data URL, reduced to 256 colours, which needs a third of the bytes.

    Drawings have few colours, so only the shades at the edges of lines change slightly.
    """
    content = BytesIO()
    with Image.open(picture) as drawing:
        drawing.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(content, "PNG")
    return f"data:image/png;base64,{base64.b64encode(content.getvalue()).decode()}"
