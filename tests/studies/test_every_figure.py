"""What holds for every figure, whatever it shows."""

import matplotlib
import pytest
import xarray as xr
from matplotlib.text import Text
from pendula.datasets.netcdf import read, save
from pendula.drawing import style
from pendula.own_cases import figures as own
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


@style.styled
def pixels(figure):
    figure.set_dpi(50)
    with style.thrifty():
        figure.canvas.draw()
        seen = bytes(figure.canvas.buffer_rgba())
    figure.set_dpi(style.DPI)
    return seen


@pytest.fixture(scope="module", params=DRAWN_BY)
def plot(request, gathered):
    """Return the figure's name, its data, the figure drawn from them, and how that looks."""
    figure = DRAWN_BY[request.param](gathered[request.param])
    return request.param, gathered[request.param], figure, pixels(figure)


def test_every_variable_is_named_and_has_units(plot, tmp_path):
    _, data, _, _ = plot
    save(tmp_path / "data.nc", data)
    for name, variable in read(tmp_path / "data.nc").variables.items():
        assert variable.attrs["long_name"] and variable.attrs["units"], name


def test_saved_data_alone_give_the_same_figure_whatever_the_users_style(plot, tmp_path):
    name, data, _, look = plot
    data.to_netcdf(tmp_path / "data.nc", engine="netcdf4")
    with matplotlib.rc_context({"font.size": 20, "lines.linewidth": 9, "axes.grid": True}):
        assert pixels(DRAWN_BY[name](xr.load_dataset(tmp_path / "data.nc"))) == look
        assert matplotlib.rcParams["font.size"] == 20


def test_text_is_legible_and_everything_is_on_the_page(plot):
    _, _, figure, _ = plot
    assert figure.get_figwidth() == style.DOUBLE
    shown = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
    assert shown
    assert min(text.get_fontsize() for text in shown) >= 7
    with style.thrifty():
        page, needed = figure.bbox_inches, figure.get_tightbbox()
    assert page.x0 <= needed.x0 and needed.x1 <= page.x1
    assert page.y0 <= needed.y0 and needed.y1 <= page.y1
