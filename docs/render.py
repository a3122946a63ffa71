"""Write the README and the pages of docs/ that quote results, from their templates.

Run as `python docs/render.py` from anywhere. A template takes its numbers from facts.py. A
test fails where a page is not what its template gives.
"""

import sys
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "docs"), str(ROOT)]

import facts  # noqa: E402
from pendula.article import write  # noqa: E402
from pendula.report.results import Results  # noqa: E402

SOURCE = ROOT / "docs/source"
ARTICLE = ROOT / "docs/article.md"


def pages() -> dict[Path, Path]:
    """Return the template of each page that has one."""
    names = sorted(path.name.removesuffix(".j2") for path in SOURCE.glob("*.md.j2"))
    folder = {"README.md": ROOT}
    found = {folder.get(name, ROOT / "docs") / name: SOURCE / f"{name}.j2" for name in names}
    return found | {ARTICLE: write.HERE / "article.md.j2"}


class Accepted(Results):
    """The accepted results, as the article reads those of a run."""

    def __init__(self):
        super().__init__((), "")

    def __contains__(self, name: str) -> bool:
        return self.path(f"{name}.nc").exists()

    def path(self, link: str) -> Path:
        return facts.BASELINE / link.removeprefix(f"{write.KEPT}/")


def render(values: dict[str, dict]) -> dict[Path, str]:
    """Return the text of each page that has a template."""
    environment = Environment(
        loader=FileSystemLoader(SOURCE), undefined=StrictUndefined, keep_trailing_newline=True,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    return {
        page: environment.get_template(template.name).render(**values)
        for page, template in pages().items()
        if page != ARTICLE
    } | {ARTICLE: write.markdown(Accepted())}


if __name__ == "__main__":
    for page, text in render(facts.topics(facts.Baseline())).items():
        if not page.exists() or page.read_text(encoding="utf-8") != text:
            page.write_text(text, encoding="utf-8")
            print(f"{page.relative_to(ROOT)} is new")
