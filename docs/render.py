"""Write the README, its animation, and the pages of docs/ that quote results.

Run `python docs/render.py` from any folder. The pages are made from templates with the numbers of
facts.py. A test fails if a page differs from the page that its template gives.
"""

from pathlib import Path

import facts
import moving_chain
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from pendula.article.write import ARTICLE

ROOT = Path(__file__).resolve().parents[1]

SOURCE = ROOT / "docs/source"
PAGES = {
    ROOT / "README.md": SOURCE / "README.md.j2",
    ROOT / "docs/accuracy_and_speed.md": SOURCE / "accuracy_and_speed.md.j2",
    ROOT / "docs/report.md": SOURCE / "report.md.j2",
    ROOT / "docs/variations.md": SOURCE / "variations.md.j2",
    ROOT / "docs/article.md": ARTICLE.folder / "article.md.j2",
}
"""The template of each page."""


def render() -> dict[Path, str]:
    """Return the text of each page in PAGES, and of the animation."""
    accepted = facts.Accepted()
    environment = Environment(
        loader=FileSystemLoader(SOURCE),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    *pages, article = PAGES
    values = facts.topics(accepted)
    texts = {page: environment.get_template(PAGES[page].name).render(**values) for page in pages}
    picture = {ROOT / "docs/moving_chain.svg": moving_chain.draw()}
    return texts | picture | {article: ARTICLE.markdown(accepted)}


if __name__ == "__main__":
    for page, text in render().items():
        if not page.exists() or page.read_text(encoding="utf-8") != text:
            page.write_text(text, encoding="utf-8")
            print(f"{page.relative_to(ROOT)} is new")
