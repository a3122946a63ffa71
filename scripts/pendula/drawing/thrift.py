"""What matplotlib does again and again while it saves one figure, done once.

A figure is laid out in two passes, drawn as PNG and drawn once more as PDF. Each of the four finds
the ticks of every axis anew, and several times: for the title above it, for the labels aligned with
its own, for its own label. Together this takes half of the time of a drawing, while the pictures
are the same to the last bit. The functions below stand in the place of those of matplotlib, whose
version is pinned, and call them when there is something new to find.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import lru_cache
from unittest.mock import patch

from fontTools import subset
from fontTools.ttLib import TTFont
from matplotlib.axis import Axis
from matplotlib.mathtext import MathTextParser

TABLES = {"glyf", "head", "hhea", "hmtx", "loca", "maxp", "cvt ", "fpgm", "prep"}
"""What a PDF takes from a font (ISO 32000-2, 9.9.2). Other tables join letters or name them, and
it takes most of the time of embedding a font to reduce those to the letters of a figure."""


@contextmanager
def thrifty() -> Iterator[None]:
    """Save a figure below this without doing anything twice; the figure must stay as it is."""
    parse = lru_cache(maxsize=None)(MathTextParser._parse_cached.__wrapped__)
    with ExitStack() as stack:
        for owner, name, new in (
            (Axis, "_update_ticks", _once(Axis._update_ticks)),
            (Axis, "_get_ticklabel_bboxes", _once(Axis._get_ticklabel_bboxes)),
            (MathTextParser, "_parse_cached", parse),
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


def _load_font(load: Callable) -> Callable:
    def loaded(*given, **named) -> TTFont:
        font = load(*given, **named)
        for table in {*font.reader.keys()} - TABLES:
            del font[table]
        return font

    return loaded
