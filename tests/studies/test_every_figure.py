"""What holds for every figure, whatever it shows, and that each shows what is accepted."""

import json
import re
from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np
import pytest
import xarray as xr
from accepted import BASELINE, changed, check_words, dataset, datasets, differing, wrong_changes
from accepted_figures import FIGURES
from helpers import skip
from latticode.datasets.netcdf import read, save
from latticode.drawing import runs, strips, style
from latticode.drawing.description import describe
from latticode.drawing.panels import BAR, OFFSET, SIZES
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser
from matplotlib.text import Text
from pendula.own_cases import figures as own
from pendula.studies.breathers.figures import LOOKS
from replication.article.render import LAYOUTS

A4 = 21.0
"""The width of a page in centimetres."""


def gather_own_norms(run, second_run):
    """Return a run with a second one of the same case, which it leaves at tau = 2."""
    second = second_run[["linf", "l2"]].rename(linf="second_linf", l2="second_l2")
    attributes = {"long_name": "first tau at which the runs differ", "units": "1"}
    return own.gather_norms(run, second.assign(divergence_time=((), 2.0, attributes)))


USER_FIGURES = {
    "own_norms": (
        own.draw_norms,
        gather_own_norms,
        "trajectories/fig2_small",
        "trajectories/fig3_small",
    ),
    "own_spacetime": (own.draw_spacetime, own.gather_spacetime, "trajectories/fig2_small"),
    "own_sweep": (
        own.draw_sweep,
        lambda sweep: runs.gather_sweep(sweep, mean_window="[10, 50]"),
        "sweeps/fig5_left",
    ),
}


@style.styled
def described(figure, data=None) -> dict:
    """Return what a figure shows; to draw it finds its ticks and its margins."""
    figure.draw_without_rendering()
    return describe(figure, xr.Dataset() if data is None else data)


def without(keys: set[str], description):
    """Return a description without some entries of curves and areas."""
    if isinstance(description, dict):
        return {key: without(keys, each) for key, each in description.items() if key not in keys}
    return (
        [without(keys, each) for each in description]
        if isinstance(description, list)
        else description
    )


OF_ROWS = {"shows", "x leaves", "y leaves"}
"""Entries that say which rows of the data a curve shows, and on which side it leaves its panel."""


class Plot(NamedTuple):
    """A figure drawn from saved data under a user's style, what it shows, and the file."""

    name: str
    figure: Figure
    displayed: dict
    file: Path


USERS = {"font.size": 20, "lines.linewidth": 9, "axes.grid": True}


@pytest.fixture(scope="module", params=FIGURES | USER_FIGURES)
def plot(request, tmp_path_factory):
    draw, gather, *names = (FIGURES | USER_FIGURES)[request.param]
    if request.param in not_accepted():
        skip(f"{request.param} is not accepted yet", "snakemake accept_figures")
    file = tmp_path_factory.mktemp(request.param) / "data.nc"
    save(file, gather(*map(dataset, names)))
    with matplotlib.rc_context(USERS):
        figure = draw(xr.load_dataset(file))
        assert matplotlib.rcParams["font.size"] == 20
        return Plot(request.param, figure, described(figure, read(file)), file)


def not_accepted() -> list[str]:
    """Return the figures of which a file, or a dataset that they show, is not in the baseline."""
    files = {
        name: [f"figures/{name}.json", *(f"{data}.nc" for data in FIGURES[name][2:])]
        for name in FIGURES
    }
    return [name for name in files if not all((BASELINE / file).exists() for file in files[name])]


def accepted(name: str) -> dict:
    """Return the accepted description of a figure; what shows a user's own run is drawn again."""
    if name in USER_FIGURES:
        draw, gather, *names = USER_FIGURES[name]
        return described(draw(gather(*map(dataset, names)))) | {"data": ""}
    return json.loads((BASELINE / f"figures/{name}.json").read_text()) | {"data": ""}


def test_saved_data_show_what_is_accepted_whatever_the_users_style(plot):
    """Each text, colour, stroke and axis, and the ranges of each curve."""
    expected, displayed = (without(OF_ROWS, each) for each in (accepted(plot.name), plot.displayed))
    difference = differing(expected, displayed | {"data": ""}, 1e-3)
    assert difference == {}, "if this is meant, look at it and type `snakemake accept_figures`"


LEAST = 100
"""Points of a curve that is no mark, no bar and no edge of a panel."""


def test_each_curve_names_the_rows_that_it_shows(plot):
    if plot.name == "growth_law":  # its curves are of fewer points
        return
    curves = [curve for panel in plot.displayed["panels"] for curve in panel.get("curves", ())]
    assert all(curve.get("shows") for curve in curves if curve["points"] >= LEAST)


def test_a_curve_that_is_reversed_or_hidden_or_cut_off_is_told():
    data = dataset("trajectories/fig4_large")
    figure = style.new_figure(4, 2)
    axes = figure.subplots()
    for component in "AB":
        axes.plot(data["tau"], data["l2"].sel(component=component))

    def described_rows() -> list[str]:
        return [curve.get("shows") for curve in described(figure, data)["panels"][0]["curves"]]

    assert described_rows() == ["l2 [A] over tau", "l2 [B] over tau"]
    axes.lines[0].set_ydata(axes.lines[0].get_ydata()[::-1])
    assert described_rows() == ["tau", "l2 [B] over tau"]
    axes.lines[1].set_visible(False)
    axes.set_ylim(5, 10)
    (curve,) = described(figure, data)["panels"][0]["curves"]
    assert curve["y leaves"] == "below and above" and curve["shows"] == "tau"


def test_every_figure_is_accepted():
    remedy = "look at its picture in results/figures, then type `snakemake accept_figures`"
    assert not_accepted() == [], remedy


def test_every_accepted_figure_is_drawn():
    drawn_no_more = {path.stem for path in (BASELINE / "figures").glob("*.json")} - FIGURES.keys()
    assert drawn_no_more == set(), "add it to tests/accepted_figures.py, or accept without it"


@pytest.mark.parametrize("row", wrong_changes("figures"), ids=lambda row: row["figure"])
def test_a_figure_tells_what_is_changed(row):
    draw, gather, *names = FIGURES[row["figure"]]
    wrong = described(draw(gather(*map((datasets(names) | changed(row)).get, names))))
    check_words(row, json.dumps(accepted(row["figure"])), json.dumps(wrong))


def test_every_variable_is_named_and_has_units(plot):
    for name, variable in read(plot.file).variables.items():
        assert variable.attrs["long_name"] and variable.attrs["units"], name


def test_every_figure_has_a_caption(plot):
    """Plain sentences, without formulas in TeX, values left out or bounds of what is not known."""
    caption = read(plot.file).attrs["caption"]
    assert len(caption) > 40 and caption.endswith(".")
    assert not set("${}\\") & set(caption) and "nan" not in caption


@style.styled
def margins(figure):
    """Return how far a drawn figure stays from the four edges of its page."""
    page, needed = figure.bbox_inches, figure.get_tightbbox()
    return needed.x0 - page.x0, needed.y0 - page.y0, page.x1 - needed.x1, page.y1 - needed.y1


def smallest(figure) -> tuple[float, float]:
    """Return the points of the smallest letter and of the smallest index as they are printed.

    The article prints a figure as large as it is drawn, unless it is wider than the text.
    """
    margin = re.search(r"margin: \(x: ([\d.]+)cm", (LAYOUTS / "article.typ").read_text())[1]
    printed = min(1.0, (A4 - 2 * float(margin)) / 2.54 / figure.get_figwidth())
    texts = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
    letters = {text.get_fontsize() for text in texts}
    formulas = [text for text in texts if text.get_text().count("$") > 1]
    parse = MathTextParser("path").parse
    glyphs = (parse(text.get_text(), 72, text.get_fontproperties()).glyphs for text in formulas)
    indices = {glyph[1] for formula in glyphs for glyph in formula}
    return printed * min(letters), printed * min(letters | indices)


def test_letters_are_legible_in_print_and_everything_is_on_the_page(plot):
    letters, indices = smallest(plot.figure)
    assert letters >= 7 and indices >= 7
    assert min(margins(plot.figure)) >= 0


def test_a_label_of_six_points_and_a_figure_wider_than_the_text_are_found():
    figure = style.new_figure(style.WIDTH, 1)
    figure.text(0, 0, "small", fontsize=6)
    assert smallest(figure) == pytest.approx((6, 6))
    wide = style.new_figure(2 * style.WIDTH, 1)
    wide.text(0, 0, "$A_0$", fontsize=8)
    assert smallest(wide) == pytest.approx((4, 2.8))


def test_the_fates_stay_apart_in_grey():
    """A quarter of the way from black to white lies between them, by the lightness of CIE 1976."""
    light = np.sort(116 * np.cbrt([luminance(colour) for colour in LOOKS.values()]) - 16)
    assert np.diff(light).min() > 25


def luminance(colour) -> float:
    """Return the relative luminance of a colour, from 0 for black to 1 for white (WCAG 2)."""
    shades = np.array(to_rgb(colour))
    linear = np.where(shades > 0.04045, ((shades + 0.055) / 1.055) ** 2.4, shades / 12.92)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(first, second) -> float:
    """Return the contrast of two colours, from 1 to 21 (WCAG 2)."""
    dark, light = sorted(map(luminance, (first, second)))
    return (light + 0.05) / (dark + 0.05)


# --- What single figures show -----------------------------------------------------------------


@pytest.mark.parametrize("fate", LOOKS)
def test_marks_on_the_map_of_fates_are_seen_on_every_fate(fate):
    """By their lightness, which people with any colour vision see: the rim or what it encloses."""
    mark = drawn("fates").axes[0].lines[0]
    colours = mark.get_markerfacecolor(), mark.get_markeredgecolor()
    assert max(contrast(LOOKS[fate], colour) for colour in colours) > 4.5


def test_every_curve_of_pendula_over_the_top_is_seen_on_white():
    (axes,) = drawn("pendula_over_the_top").axes
    curves = [line for line in axes.lines if line.get_drawstyle() == "steps-post"]
    assert min(contrast(line.get_color(), "white") for line in curves) > 3.0


@pytest.mark.parametrize("name", ["fig2", "fig3", "fig4"])
def test_the_reference_lies_under_each_run_to_its_end(name):
    figure = dataset(f"figures/{name}")
    widths = {strips.UNDER["lw"]}
    under = [line for axes in drawn(name).axes for line in axes.lines if line.get_lw() in widths]
    assert len(under) == 8  # two cases, two norms, and A and B
    for size in figure["initial_size"].values:
        true = figure["true_l2"].sel(initial_size=size, component="A").dropna("tau")
        assert any(np.array_equal(line.get_ydata(), true) for line in under)


def drawn(name: str) -> Figure:
    """Return a figure of accepted datasets."""
    draw, gather, *names = FIGURES[name]
    return draw(gather(*map(dataset, names)))


@pytest.mark.parametrize(
    ("name", "label"),
    [("fig2", "wide, pale: multiprecision reference"), ("growth_law", "range of the ensemble")],
)
def test_a_key_of_what_is_red_and_blue_has_both_colours(name, label):
    (legend,) = drawn(name).legends
    place = [text.get_text() for text in legend.texts].index(label)
    key = [
        artist
        for column in legend._legend_handle_box.get_children()
        for artist in column.get_children()
    ][place]
    artists = key.get_children()[0].get_children()
    colours = [
        artist.get_facecolor() if hasattr(artist, "get_facecolor") else artist.get_color()
        for artist in artists
    ]
    red, blue = map(to_rgb, colours)
    assert red[0] > red[2] and blue[2] > blue[0]


def test_the_law_of_growth_has_a_panel_in_which_a_tenth_is_seen():
    """Where one panel held five decades, a norm that is off by a tenth was on the law."""
    *_, ratio = drawn("growth_law").axes
    low, high = ratio.get_ylim()
    assert ratio.get_yscale() == "linear" and high - low < 1.0 and low < 1.0 < high


def test_fronts_have_the_predicted_speed_of_the_second_one_for_the_chain_of_the_long_study_alone():
    fronts, long = dataset("unbounded/fronts"), dataset("quoted/unbounded")
    gather = FIGURES["fronts"][1]
    gathered = gather(fronts, long)["predicted_second_speed"]
    np.testing.assert_array_equal(
        gathered, long["predicted_second_speed"].sel(omega=gathered["omega"])
    )
    assert gather(fronts)["predicted_second_speed"].isnull().all()
    another_chain = fronts.assign_attrs(gamma=2.0)
    assert gather(another_chain, long)["predicted_second_speed"].isnull().all()
    lines = drawn("fronts").axes[0].lines
    assert any(np.array_equal(speeds.get_ydata(), gathered, equal_nan=True) for speeds in lines)


def test_an_axis_of_time_has_no_ticks_beyond_the_end_and_equal_shares_are_seen():
    figure = drawn("pendula_over_the_top")
    figure.draw_without_rendering()
    (axes,), end = figure.axes, float(dataset("pendula/over_the_top")["tau"][-1])
    assert max(axes.get_xticks()) <= end < axes.get_xlim()[1]
    steps = [line.get_linewidth() for line in axes.lines if line.get_drawstyle() == "steps-post"]
    assert len(steps) > 5 and np.all(np.diff(steps) < 0.0)


def test_bars_of_an_ensemble_cover_no_mark():
    """Beside its mark, a bar keeps half of the width of both away from it, on paper."""
    figure = drawn("fig5")
    figure.draw_without_rendering()
    right = figure.axes[1]
    at = [right.transData.transform((m, 1.0))[0] for m in (100.0, OFFSET * 100.0)]
    widths = [72.0 / figure.dpi * (at[1] - at[0]), 0.5 * max(SIZES.values()) + BAR["capsize"]]
    assert widths[0] > widths[1]
