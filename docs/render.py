"""Write the README and the pages of docs/ from their templates and the committed datasets.

Run as `python docs/render.py` from anywhere. The templates are docs/source/*.md.j2, the numbers in
them come from docs/facts, and tests/docs fails where a page is not what its template gives.
"""

import re
import sys
import textwrap
from pathlib import Path

import yaml
from jinja2 import Environment, FileSystemLoader, StrictUndefined

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / name) for name in ("scripts", "docs", "")]

from facts.baseline import Baseline  # noqa: E402
from facts.topics import gather  # noqa: E402

TIED = "\0=\0"
"""Stands for " = " while lines are filled, so that none ends between a symbol and its value."""

SOURCE, BASELINE = ROOT / "docs/source", ROOT / "tests/baseline"


def pages() -> dict[Path, Path]:
    """Return the template of each page."""
    names = sorted(path.name.removesuffix(".j2") for path in SOURCE.glob("*.md.j2"))
    folder = {"README.md": ROOT}
    return {folder.get(name, ROOT / "docs") / name: SOURCE / f"{name}.j2" for name in names}


def known(baseline: Baseline) -> dict[str, dict]:
    """Return all facts, from the datasets of a baseline and from the project's configuration."""
    names = ("config", "chaos")
    texts = ((ROOT / f"config/{name}.yaml").read_text(encoding="utf-8") for name in names)
    return gather(baseline, *map(yaml.safe_load, texts))


def render(values: dict[str, dict]) -> dict[Path, str]:
    """Return the text of each page, which quotes these facts."""
    environment = Environment(
        loader=FileSystemLoader(SOURCE), undefined=StrictUndefined, keep_trailing_newline=True,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    return {
        page: filled(environment.get_template(template.name).render(**values))
        for page, template in pages().items()
    }


def filled(text: str) -> str:
    """Return Markdown with the lines of each paragraph filled, since facts differ in length.

    Code, tables, headings, pictures and comments keep their lines.
    """
    kept = re.compile(r"    |\||#|!|<!--")
    lines, paragraph, code = [], [], False
    for line in [*text.splitlines(), ""]:
        fence = line.startswith("```")
        starts_item = line.startswith("- ")
        ends = fence or code or starts_item or not line or (kept.match(line) and not paragraph)
        if ends and paragraph:
            indent = "  " if paragraph[0].startswith("- ") else ""
            words = " ".join(part.strip() for part in paragraph).replace(" = ", TIED)
            wrapped = textwrap.wrap(
                words, 100, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
            )
            lines += [line.replace(TIED, " = ") for line in wrapped]
            paragraph = []
        if ends and not starts_item:
            lines.append(line)
        else:
            paragraph.append(line)
        code ^= fence
    return "\n".join(lines[:-1]) + "\n"


if __name__ == "__main__":
    for page, text in render(known(Baseline(BASELINE))).items():
        if not page.exists() or page.read_text(encoding="utf-8") != text:
            page.write_text(text, encoding="utf-8")
            print(f"{page.relative_to(ROOT)} is new")
