"""What matplotlib does again and again while it saves one figure, done once.

A figure is laid out in two passes, drawn as PNG and drawn once more as PDF. Each of the four finds
the ticks of every axis anew, and several times: for the title above it, for the labels aligned with
its own, for its own label; and each time it measures their words. Together this takes half of the
time of a drawing, while the pictures are the same to the last bit. The functions below stand in the
place of those of matplotlib, whose version is pinned, and call them when there is something new.

The letters of a formula are placed at the resolution of the PNG, and their places are scaled for
the PDF. Otherwise each formula would be read twice, and the sizes of formulas would be rounded to
whole points in the PDF, so that they would stand a little elsewhere than in the PNG.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from copy import copy
from functools import lru_cache
from unittest.mock import patch

from fontTools import subset
from fontTools.ttLib import TTFont
from matplotlib.axis import Axis
from matplotlib.font_manager import FontProperties
from matplotlib.ft2font import LoadFlags
from matplotlib.mathtext import MathTextParser, VectorParse
from matplotlib.text import Text

TABLES = {"glyf", "head", "hhea", "hmtx", "loca", "maxp", "cvt ", "fpgm", "prep"}
"""What a PDF takes from a font (ISO 32000-2, 9.9.2). Other tables join letters or name them, and
it takes most of the time of embedding a font to reduce those to the letters of a figure."""
UNPACKED = ("loca", "glyf", "hmtx")
"""Those of a length that goes with the number of letters, which are thousands."""

DPI = 300
"""The resolution of the PNG, in pixels per inch."""

_FORMULAS = MathTextParser("path")
_read = MathTextParser._parse_cached.__wrapped__


@contextmanager
def thrifty() -> Iterator[None]:
    """Save a figure below this without doing anything twice; the figure must stay as it is."""
    with ExitStack() as stack:
        for owner, name, new in (
            (Axis, "_update_ticks", _once(Axis._update_ticks)),
            (Axis, "_get_ticklabel_bboxes", _once(Axis._get_ticklabel_bboxes)),
            (Text, "_get_layout", _laid_out_once(Text._get_layout)),
            (MathTextParser, "_parse_cached", _placed),
            (subset, "load_font", _load_font(subset.load_font)),
        ):
            stack.enter_context(patch.object(owner, name, new))
        yield


def _once(find: Callable) -> Callable:
    """Return `find` of an axis, which is called anew where the axis has another size or limits.

    Only the last answer is kept, since the ticks are the axis' own and show the last one.
    """
    last = {}

    def found(axis: Axis, *given) -> list:
        key = _state(axis), given[1:]
        if axis not in last or last[axis][0] != key:
            last[axis] = key, find(axis, *given)
        return last[axis][1]

    return found


def _state(axis: Axis) -> dict:
    """Return what ticks depend on: limits and place in pixels, also of an axis that it shares."""
    owners = {axis, axis.get_major_locator().axis, axis.get_minor_locator().axis}
    return {one: (*one.get_view_interval(), *one.axes.bbox.bounds) for one in owners}


def _laid_out_once(lay_out: Callable) -> Callable:
    """Return `lay_out` of a text, which is called anew for other words, turns or resolutions."""
    last = {}

    def laid_out(text: Text, renderer):
        if text.get_wrap() or text.get_transform_rotates_text():
            return lay_out(text, renderer)
        look = text.get_fontsize(), text.get_rotation(), text.get_ha(), text.get_va()
        key = text.get_text(), look, type(renderer), text.get_figure(root=True).dpi
        if text not in last or last[text][0] != key:
            last[text] = key, lay_out(text, renderer)
        return last[text][1]

    return laid_out


def _placed(
    parser: MathTextParser, text: str, dpi: float, look: FontProperties, *flags
) -> VectorParse:
    """Return the places of the letters of a formula at any resolution."""
    if parser._output_type != "vector":
        return _read(parser, text, dpi, look, *flags)
    found, scale = _placed_once(text, look, *flags), dpi / DPI
    if scale == 1:
        return found
    glyphs = [(*letter, x * scale, y * scale) for *letter, x, y in found.glyphs]
    rects = [tuple(length * scale for length in rect) for rect in found.rects]
    return VectorParse(*(length * scale for length in found[:3]), glyphs, rects)


@lru_cache(maxsize=1000)
def _placed_once(
    text: str, look: FontProperties, antialiased: bool, flags: LoadFlags
) -> VectorParse:
    return _read(_FORMULAS, text, DPI, look, antialiased, flags)


def _load_font(load: Callable) -> Callable:
    def loaded(path: str, *given, **named) -> TTFont:
        font = load(path, *given, **named)
        for table in {*font.reader.keys()} - TABLES:
            del font[table]
        known = _unpacked(path)
        font.setGlyphOrder(known.getGlyphOrder())
        for name in UNPACKED:
            font.tables[name] = copy(known.tables[name])
        font.tables["glyf"].glyphs = _Copied(known.tables["glyf"].glyphs)
        return font

    return loaded


@lru_cache
def _unpacked(path: str) -> TTFont:
    """Return a font with all of UNPACKED in memory, since that takes longer than all else."""
    with TTFont(path, lazy=True) as font:
        for table in {*font.reader.keys()} - TABLES:
            del font[table]
        for name in UNPACKED:
            font[name]
        return font


class _Copied(dict):
    """Glyphs by name: each is copied before it is given away, since the embedding changes it."""

    def __init__(self, shared: dict):
        super().__init__(shared)
        self._shared = set(shared)

    def __getitem__(self, name: str):
        if name in self._shared:
            self._shared.remove(name)
            self[name] = copy(super().__getitem__(name))
        return super().__getitem__(name)
