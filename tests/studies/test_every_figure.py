"""What holds for every figure, whatever it shows, and that each shows what is accepted."""

import json
from pathlib import Path
from typing import NamedTuple

import matplotlib
import pytest
import xarray as xr
from accepted import BASELINE, changed, check_words, dataset, datasets, differing, wrong_changes
from accepted_figures import FIGURES
from matplotlib.figure import Figure
from matplotlib.text import Text
from pendula.datasets.netcdf import read, save
from pendula.drawing import style
from pendula.drawing.description import describe
from pendula.own_cases import figures as own
from pendula.studies.unbounded.front_figure import WIDTH


def gather_own_norms(run, other):
    """Return a run with a second one of the same case, which it leaves at tau = 2."""
    second = other[["linf", "l2"]].rename(linf="second_linf", l2="second_l2")
    about = {"long_name": "first tau at which the runs differ", "units": "1"}
    return own.gather_norms(run, second.assign(divergence_time=((), 2.0, about)))


OWN = {
    "own_norms": (own.draw_norms, gather_own_norms,
                  "trajectories/fig2_small", "trajectories/fig3_small"),
    "own_spacetime": (own.draw_spacetime, own.gather_spacetime, "trajectories/fig2_small"),
    "own_sweep": (own.draw_sweep, lambda one: own.gather_sweep(one, mean_window="[10, 40]"),
                  "sweeps/fig5_left"),
}  # fmt: skip


@style.styled
def described(figure) -> dict:
    """Return what a figure shows; to draw it finds its ticks and its margins."""
    figure.draw_without_rendering()
    return describe(figure, xr.Dataset())


class Plot(NamedTuple):
    """A figure drawn from saved data under a user's style, what it shows, and the file."""

    name: str
    figure: Figure
    shown: dict
    file: Path


USERS = {"font.size": 20, "lines.linewidth": 9, "axes.grid": True}


@pytest.fixture(scope="module", params=FIGURES | OWN)
def plot(request, tmp_path_factory):
    draw, gather, *names = (FIGURES | OWN)[request.param]
    file = tmp_path_factory.mktemp(request.param) / "data.nc"
    save(file, gather(*map(dataset, names)))
    with matplotlib.rc_context(USERS):
        figure = draw(xr.load_dataset(file))
        assert matplotlib.rcParams["font.size"] == 20
        return Plot(request.param, figure, described(figure), file)


MORE_DIGITS = {
    "stability_chart": (".panels.1.y.ticks", ".panels.2.x.ticks"),
}
"""What rounded datasets change in a figure: ticks at an end of an axis, as they stand."""


def accepted(name: str) -> dict:
    """Return the accepted description of a figure; what shows a user's own run is drawn again."""
    if name in OWN:
        draw, gather, *names = OWN[name]
        return described(draw(gather(*map(dataset, names)))) | {"data": ""}
    return json.loads((BASELINE / f"figures/{name}.json").read_text()) | {"data": ""}


def test_saved_data_show_what_is_accepted_whatever_the_users_style(plot):
    """Each text, colour, stroke and axis, and the ranges of each curve."""
    apart = differing(accepted(plot.name), plot.shown | {"data": ""}, 1e-3)
    rounded = MORE_DIGITS.get(plot.name, "none")
    assert {at: pair for at, pair in apart.items() if not at.startswith(rounded)} == {}


def test_every_accepted_figure_is_drawn():
    assert {path.stem for path in (BASELINE / "figures").glob("*.json")} == FIGURES.keys()


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


def test_text_is_legible_and_everything_is_on_the_page(plot):
    assert plot.figure.get_figwidth() in (WIDTH, style.DOUBLE)
    texts = [text for text in plot.figure.findobj(Text) if text.get_text() and text.get_visible()]
    assert texts
    assert min(text.get_fontsize() for text in texts) >= 7
    assert min(margins(plot.figure)) >= 0
