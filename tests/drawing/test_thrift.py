"""Saving a figure without doing anything twice: the same pictures, and fonts that a PDF can use."""

import re
import zlib
from collections import Counter
from contextlib import nullcontext
from io import BytesIO

import numpy as np
import pytest
from fontTools.ttLib import TTFont
from matplotlib._mathtext import Parser
from matplotlib.axis import Axis
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser
from pendula.drawing import style, thrift

FORMULAS = [r"$\tau$", r"$10^{-3}$", r"$(A_{0}, B_{0}) = (1, 0.1)$", r"$\ell^\infty$, $\sqrt{2}$"]


def draw(formulas=True):
    """Return a figure with shared axes, aligned labels, a colour bar, and titles below ticks."""
    figure = style.new_figure(4, 3)
    grid = figure.subplots(2, 2, sharex=True, sharey="col")
    for row, (left, right) in enumerate(grid):
        left.plot(np.arange(1.0, 9.0) ** 5, label="$x^5$" if formulas else "power")
        left.set_yscale("log" if formulas else "linear")
        left.set_ylabel(r"$10^{9}$ and more" if row and formulas else "more")
        image = right.imshow(np.eye(3), extent=(0, 7, -0.5, 0.5), aspect="auto")
        right.set_title(f"row {row}", loc="left")
        right.xaxis.tick_top()
    figure.colorbar(image, ax=grid[:, 1].tolist())
    figure.align_ylabels()
    style.name_legend(figure, *grid.flat)
    return figure


@style.styled
def save(thrifty, formulas=True):
    """Return the pixels of a figure and its PDF."""
    figure = draw(formulas)
    with thrifty(), BytesIO() as pdf:
        figure.canvas.draw()
        pixels = np.array(figure.canvas.buffer_rgba())
        figure.set_layout_engine("none")
        FigureCanvasPdf(figure).print_pdf(pdf, metadata={"CreationDate": None})
        return pixels, pdf.getvalue()


@pytest.fixture(scope="module")
def saved():
    return {"thrifty": save(thrift.thrifty), "plain": save(nullcontext)}


def streams(pdf):
    """Return what the streams of a PDF hold, unpacked."""
    packed = re.findall(rb"\sstream\r?\n(.*?)\r?\nendstream", pdf, re.DOTALL)
    return [zlib.decompress(one) if one[:1] == b"x" else one for one in packed]


def fonts(pdf):
    return [TTFont(BytesIO(one)) for one in streams(pdf) if one[:4] == b"\0\1\0\0"]


def test_the_pixels_are_those_of_matplotlib_alone(saved):
    assert np.array_equal(saved["thrifty"][0], saved["plain"][0])


def test_a_pdf_without_formulas_is_that_of_matplotlib_alone_but_for_its_fonts():
    thrifty, plain = (
        [one for one in streams(save(how, formulas=False)[1]) if one[:4] != b"\0\1\0\0"]
        for how in (thrift.thrifty, nullcontext)
    )
    assert thrifty == plain and len(plain) > 3


@pytest.mark.parametrize("formula", FORMULAS)
def test_letters_of_formulas_stand_where_matplotlib_puts_them_to_two_points(formula):
    plain = MathTextParser("path").parse(formula, 72, FontProperties(size=8))
    with thrift.thrifty():
        fine = MathTextParser("path").parse(formula, 72, FontProperties(size=8))
    np.testing.assert_allclose(fine[:3], plain[:3], atol=2.0)  # height and depth are rounded up
    assert [glyph[2:4] for glyph in fine.glyphs] == [glyph[2:4] for glyph in plain.glyphs]
    sizes = [[glyph[1] for glyph in one.glyphs] for one in (fine, plain)]
    np.testing.assert_allclose(*sizes, rtol=1e-2)
    places = [np.array([glyph[4:] for glyph in one.glyphs]) for one in (fine, plain)]
    np.testing.assert_allclose(*places, atol=2.0)
    if plain.rects:
        np.testing.assert_allclose(fine.rects, plain.rects, atol=2.0)


@pytest.fixture(scope="module")
def again(saved):
    """Return the PDF of the figure saved once more, and how often each formula was read for it."""
    read, parse = Counter(), Parser.parse

    def count(parser, text, *given):
        read[text] += 1
        return parse(parser, text, *given)

    thrift._placed_once.cache_clear()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Parser, "parse", count)
        return save(thrift.thrifty)[1], read


def test_each_formula_is_read_once_for_both_pictures(again):
    _, read = again
    assert len(read) > 3 and set(read.values()) == {1}


def test_fonts_hold_the_outlines_of_matplotlib_alone_and_nothing_to_set_text_with(saved):
    thrifty, plain = fonts(saved["thrifty"][1]), fonts(saved["plain"][1])
    assert len(thrifty) == len(plain) > 1
    for slim, full in zip(thrifty, plain, strict=True):
        assert {*slim.keys()} - {"GlyphOrder"} <= thrift.TABLES < {*full.keys()}
        shapes = [
            [font["glyf"][name].getCoordinates(font["glyf"])[0] for name in font.getGlyphOrder()]
            for font in (slim, full)
        ]
        assert all(map(np.array_equal, *shapes))
        assert [*slim["hmtx"].metrics.values()] == [*full["hmtx"].metrics.values()]


def test_a_font_is_embedded_alike_again(saved, again):
    """What stays in memory of a font is not what an earlier figure has changed."""
    assert again[0] == saved["thrifty"][1]


def test_a_text_is_measured_anew_where_it_changes():
    figure = draw()
    text = figure.text(0.5, 0.5, "one")
    with thrift.thrifty():
        renderer = figure.canvas.get_renderer()
        boxes = [text.get_window_extent(renderer).bounds]
        for name, value in {"text": "more", "fontsize": 20, "rotation": 40, "ha": "right"}.items():
            text.set(**{name: value})
            boxes.append(text.get_window_extent(renderer).bounds)
        figure.dpi = 50
        boxes.append(text.get_window_extent().bounds)
    assert len(set(boxes)) == 6


def test_ticks_are_found_anew_where_limits_or_sizes_change():
    figure = draw()
    axes = figure.axes[0]
    with thrift.thrifty():
        figure.canvas.draw()
        before = [tick.get_loc() for tick in axes.yaxis._update_ticks()]
        axes.set_ylim(1, 10)
        limited = [tick.get_loc() for tick in axes.yaxis._update_ticks()]
        axes.set_yscale("linear")
        figure.set_size_inches(4, 1)
        small = [tick.get_loc() for tick in axes.yaxis._update_ticks()]
    assert before != limited != small


def test_matplotlib_is_as_it_was_afterwards():
    before = Axis._update_ticks
    with pytest.raises(KeyError), thrift.thrifty():
        assert Axis._update_ticks is not before
        raise KeyError
    assert Axis._update_ticks is before
