"""What holds for every figure, whatever it shows."""

import itertools
import json

import matplotlib
import numpy as np
import pytest
import xarray as xr
from helpers import ROOT
from matplotlib.lines import Line2D
from matplotlib.text import Text
from pendula.datasets.netcdf import read, save
from pendula.drawing import style
from pendula.drawing.description import describe
from pendula.own_cases import figures as own
from pendula.studies.breathers import fate_figures
from pendula.studies.breathers import figures as breathers
from pendula.studies.certified import figures as certified
from pendula.studies.chaos import figures as chaos
from pendula.studies.chaos import lifetimes_figure
from pendula.studies.paper import chain_figure, figures
from pendula.studies.pendula import (
    over_the_top_figure,
    phases_figure,
    remainder_figure,
    threshold_figure,
)
from pendula.studies.theory import bounds_figure
from pendula.studies.theory import figures as theory
from pendula.studies.unbounded import figures as unbounded
from pendula.studies.unbounded import front_figure

DRAWN_BY = {
    "chain": chain_figure.draw,
    "norms": figures.draw_norms,
    "spacetime": figures.draw_spacetime,
    "sweeps": figures.draw_sweeps,
    "drift": figures.draw_drift,
    "agreement": figures.draw_agreement,
    "trust": figures.draw_trust,
    "stability_chart": theory.draw_chart,
    "growth_rates": theory.draw_rates,
    "pendula_threshold": threshold_figure.draw_threshold,
    "certified_curves": certified.draw_curves,
    "pendula_remainder": remainder_figure.draw_remainder,
    "pendula_phases": phases_figure.draw_phases,
    "pendula_over_the_top": over_the_top_figure.draw_over_the_top,
    "bounds": bounds_figure.draw_bounds,
    "lyapunov": chaos.draw_lyapunov,
    "symmetry": chaos.draw_symmetry,
    "ensembles": chaos.draw_ensembles,
    "lifetimes": lifetimes_figure.draw_lifetimes,
    "growth_law": unbounded.draw_growth_law,
    "front": front_figure.draw_front,
    "window_map": unbounded.draw_window_map,
    "own_norms": own.draw_norms,
    "own_spacetime": own.draw_spacetime,
    "own_sweep": own.draw_sweep,
}

ACCEPTED = {path.stem: path for path in sorted((ROOT / "tests/baseline/figures").glob("*.json"))}
DRAWN_FROM_ACCEPTED = DRAWN_BY | {
    "fig1": chain_figure.draw,
    **{f"fig{n}": figures.draw_norms for n in (2, 3, 4)},
    **{f"fig{n}_spacetime": figures.draw_spacetime for n in (2, 3, 4)},
    **{f"fig{n}": figures.draw_sweeps for n in (5, 6)},
    "energy_drift": figures.draw_drift,
    "solver_agreement": figures.draw_agreement,
    "trust_horizons": figures.draw_trust,
    "breathers": breathers.draw_breathers,
    "fates": fate_figures.draw_fates,
    "sensitivity": breathers.draw_sensitivity,
}


@style.styled
def look(figure):
    """Return what a figure shows, with the sizes of its texts and the strokes of all its lines."""
    texts = [(text.get_text(), text.get_fontsize()) for text in figure.findobj(Text)]
    lines = [
        (line.get_linewidth(), line.get_visible(), line.get_xydata().tobytes())
        for line in figure.findobj(Line2D)
    ]
    return describe(figure, xr.Dataset()), texts, lines


@pytest.fixture(scope="module", params=DRAWN_BY)
def plot(request, gathered, tmp_path_factory):
    """Return the name of a figure, the figure, how it looks, and the file with its data."""
    data = gathered[request.param]
    figure = DRAWN_BY[request.param](data)
    file = tmp_path_factory.mktemp(request.param) / "data.nc"
    save(file, data)
    return request.param, figure, look(figure), file


def test_every_variable_is_named_and_has_units(plot):
    for name, variable in read(plot[-1]).variables.items():
        assert variable.attrs["long_name"] and variable.attrs["units"], name


def test_saved_data_alone_give_the_same_figure_whatever_the_users_style(plot):
    name, _, shown, file = plot
    with matplotlib.rc_context({"font.size": 20, "lines.linewidth": 9, "axes.grid": True}):
        again = DRAWN_BY[name](xr.load_dataset(file))
        assert matplotlib.rcParams["font.size"] == 20
    assert look(again) == shown


@style.styled
def margins(figure):
    """Return how far the figure stays from the left, lower, right and upper edge of its page."""
    with style.thrifty():
        if layout := figure.get_layout_engine():
            layout.execute(figure)
        page, needed = figure.bbox_inches, figure.get_tightbbox()
    return needed.x0 - page.x0, needed.y0 - page.y0, page.x1 - needed.x1, page.y1 - needed.y1


def test_text_is_legible_and_everything_is_on_the_page(plot):
    _, figure, _, _ = plot
    assert figure.get_figwidth() == style.DOUBLE
    shown = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
    assert shown
    assert min(text.get_fontsize() for text in shown) >= 7
    assert min(margins(figure)) >= 0


@pytest.mark.parametrize("name", ACCEPTED)
def test_the_accepted_data_in_single_precision_give_the_panels_of_the_figure(name):
    data = accepted_data(name)
    drawn = describe(DRAWN_FROM_ACCEPTED[name](data), data)
    assert len(drawn["panels"]) == len(json.loads(ACCEPTED[name].read_text())["panels"])


def accepted_data(name):
    return read(ACCEPTED[name].with_suffix(".nc"))


def places_of(axes):
    """Return where marks of each colour stand in a panel, in points of the page."""
    lines = [line for line in axes.lines if line.get_marker() not in ("None", "", None)]
    with_marks = (line for line in lines if line.get_linestyle() == "None")
    return [
        (line.get_color(), line.get_markersize(), place * 72.0 / axes.figure.dpi)
        for line in with_marks
        for place in line.get_transform().transform(line.get_xydata())
        if axes.bbox.contains(*place)
    ]


@style.styled
def test_marks_of_collisions_cover_no_other_mark():
    """Each is further from any other mark than both are wide; each panel and inset by itself."""
    figure = breathers.draw_breathers(accepted_data("breathers"))
    figure.canvas.draw()
    panels = [panel for axes in figure.axes for panel in (axes, *axes.child_axes)]
    shown = [places_of(panel) for panel in panels]
    assert sum(colour == "black" for marks in shown for colour, _, _ in marks) == 4
    for marks in shown:
        for one, other in itertools.combinations(marks, 2):
            if "black" in (one[0], other[0]):
                assert np.hypot(*(one[2] - other[2])) > 0.5 * (one[1] + other[1])


def test_it_is_said_of_which_instant_the_p_of_a_periodic_breather_is():
    drawn = accepted_data("breathers")
    families = breathers.draw_breathers(drawn).axes[: drawn.sizes["omega"]]
    assert all("real" in axes.get_ylabel() for axes in families)


def test_a_line_shows_mu_by_its_colour_alone():
    """Shades and dashes of one colour lie on each other where norms are nearly equal."""
    figure = phases_figure.draw_phases(accepted_data("pendula_phases"))
    for axes in figure.axes:
        assert len({line.get_color() for line in axes.lines}) == len(axes.lines)
        assert {line.get_linestyle() for line in axes.lines} <= {"-"}
    colours = [matplotlib.colors.to_rgb(line.get_color()) for line in figure.axes[0].lines]
    hues = [matplotlib.colors.rgb_to_hsv(one)[0] for one in colours[1:]]
    apart = [abs((a - b + 0.5) % 1.0 - 0.5) for a, b in itertools.combinations(hues, 2)]
    assert min(apart) > 0.08


def test_each_width_of_a_line_is_named_and_each_axis_says_what_it_is():
    drawn = accepted_data("pendula_remainder")
    _, growth, horizon = remainder_figure.draw_remainder(drawn).axes
    looks = {(line.get_linewidth(), line.get_alpha()) for line in growth.lines}
    named = {
        (line.get_linewidth(), line.get_alpha()): text.get_text()
        for line, text in zip(
            growth.get_legend().get_lines(), growth.get_legend().get_texts(), strict=True
        )
    }
    assert looks == set(named) and len(looks) == 4
    pairs = zip(drawn["mu"].values[2:], named.values(), strict=True)
    assert all(f"{mu:g}" in text for mu, text in pairs)
    assert "at which the error is visible" in horizon.get_ylabel()
