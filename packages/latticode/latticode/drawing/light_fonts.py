"""DejaVu Sans for a PDF: all letters, without the tables that it takes longest to cut down.

For each PDF, matplotlib cuts a font down to the letters that the figure uses. About half of this
time goes into the tables of ligatures and of marks on letters, which the PDF does not need.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from fontTools.ttLib import TTFont
from matplotlib.font_manager import FontProperties, fontManager

from latticode.datasets import DatasetError, not_written

FAMILY, SLANTS = "DejaVu Sans", ("normal", "oblique")
LEFT_OUT = ("GDEF", "GPOS", "GSUB")
"""OpenType: classes, places and replacements of letters; letters that are drawn closer together
when they meet are named in the older table "kern" too."""


@contextmanager
def light_fonts() -> Iterator[None]:
    """Let matplotlib find such fonts in place of the whole ones, and the whole ones afterwards.

    Raises DatasetError if they find no room in the folder for temporary files.
    """
    fonts = [FontProperties(family=FAMILY, style=slant) for slant in SLANTS]
    paths = [Path(fontManager.findfont(font)) for font in fonts]
    before = list(fontManager.ttflist)
    with _temporary_folder() as folder:
        try:
            for font in paths:
                fontManager.addfont(_without_tables(font, folder))
            # of fonts that suit equally well, matplotlib takes the first
            fontManager.ttflist[:] = fontManager.ttflist[len(before) :] + before
            yield
        finally:
            fontManager.addfont(paths[0])  # for then matplotlib forgets which fonts it has found
            fontManager.ttflist[:] = before


@contextmanager
def _temporary_folder() -> Iterator[Path]:
    try:
        temporary = TemporaryDirectory()
    except OSError as error:  # its text names all folders that were tried
        text = f"{error.strerror}: make room in one, or name another folder in TMPDIR"
        raise DatasetError(text) from error
    with temporary as folder:
        yield Path(folder)


def _without_tables(font: Path, folder: Path) -> Path:
    """Return a copy of a font in this folder without the tables that are left out."""
    with TTFont(font, lazy=True, recalcBBoxes=False, recalcTimestamp=False) as opened:
        for table in LEFT_OUT:
            if table in opened:
                del opened[table]
        try:
            opened.save(folder / font.name, reorderTables=None)
        except OSError as error:
            raise not_written(folder / font.name, error) from error
    return folder / font.name
