"""DejaVu Sans without some OpenType tables: PDF files are written faster with these fonts.

For each PDF, matplotlib reduces a font to the letters that the figure uses. About half of this time
goes into tables of ligatures and accents, which the PDF does not need.
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
"""OpenType tables of classes, positions and substitutions of letters. Kerning does not need them,
because the older table "kern" contains it too."""


@contextmanager
def light_fonts() -> Iterator[None]:
    """Let matplotlib use the reduced fonts inside the block.

    Raises DatasetError if they cannot be written to the folder for temporary files.
    """
    fonts = [FontProperties(family=FAMILY, style=slant) for slant in SLANTS]
    paths = [Path(fontManager.findfont(font)) for font in fonts]
    before = list(fontManager.ttflist)
    with _temporary_folder() as folder:
        try:
            for font in paths:
                fontManager.addfont(_without_tables(font, folder))
            # matplotlib uses the first of several fonts that match equally well
            fontManager.ttflist[:] = fontManager.ttflist[len(before) :] + before
            yield
        finally:
            fontManager.addfont(paths[0])  # clears matplotlib's cache of matching fonts
            fontManager.ttflist[:] = before


@contextmanager
def _temporary_folder() -> Iterator[Path]:
    try:
        temporary = TemporaryDirectory()
    except OSError as error:  # the message lists all folders that were tried
        text = f"{error.strerror}: free space in one of them, or set TMPDIR to another folder"
        raise DatasetError(text) from error
    with temporary as folder:
        yield Path(folder)


def _without_tables(font: Path, folder: Path) -> Path:
    """Return the path of a copy of a font, in `folder`, without the tables LEFT_OUT."""
    with TTFont(font, lazy=True, recalcBBoxes=False, recalcTimestamp=False) as opened:
        for table in LEFT_OUT:
            if table in opened:
                del opened[table]
        try:
            opened.save(folder / font.name, reorderTables=None)
        except OSError as error:
            raise not_written(folder / font.name, error) from error
    return folder / font.name
