"""The page of an article: its cards, its script, and what runs in it."""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from replication.report import page

from .cards import Card, functions_of

HERE = Path(__file__).parent
SCRIPT = "cards.js"
ANNOTATION = re.compile(r"<annotation .*?</annotation>")
"""The TeX of a formula, which readers aloud, and whoever copies it, would get as well."""


class LiveParts(NamedTuple):
    """What a page holds beside its text: HTML below figures by their ids, data, a script."""

    below_figures: Mapping[str, str]
    data: str
    script: str
    style: str


def complete_page(html: str, cards: Iterable[Card], live: LiveParts | None) -> str:
    """Return a page that Pandoc made with its cards and its script, and with live figures."""
    cards = list(cards)
    script = (HERE / SCRIPT).read_text(encoding="utf-8") + (live.script if live else "")
    for figure, below in live.below_figures.items() if live else ():
        html = re.sub(
            rf'(<figure id="{figure}">.*?</figure>)',
            lambda match, below=below: f"{match[1]}\n{below}",
            html,
            count=1,
            flags=re.DOTALL,
        )
    parts = {
        "<!-- cards -->": page.render(
            "cards.html.j2", HERE, cards=cards, functions=functions_of(cards)
        ),
        "<!-- script -->": f"{live.data if live else ''}<script>{script}</script>",
        "/* style of live figures */": live.style if live else "",
        "(hash of the script)": page.digest(script),
    }
    html = ANNOTATION.sub("", html)
    for place, content in parts.items():
        html = html.replace(place, content)
    return html
