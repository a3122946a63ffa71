"""Tables in Markdown: the one place where the project writes them."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from tabulate import tabulate

from pendula.datasets.files import complete_or_absent


def markdown(head: Sequence[str], rows: Iterable[Sequence]) -> str:
    """Return a table with a title above each column; a cell is shown as `str` writes it."""
    cells = [[str(cell).replace("|", "\\|") for cell in row] for row in rows]
    # cells are texts already, and keep their own width: one long cell would widen every row
    titles = [title.replace("|", "\\|") for title in head]
    return tabulate(cells, titles, "github", stralign=None, disable_numparse=True)


def write_page(path: str | Path, *parts: str) -> None:
    """Write a page of Markdown: titles, paragraphs and tables with an empty line between them."""
    with complete_or_absent(path) as partial:
        Path(partial).write_text("\n\n".join(parts) + "\n", encoding="utf-8")
