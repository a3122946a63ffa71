"""What holds for every figure, whatever it shows."""

from importlib import import_module
from io import BytesIO

import matplotlib
import pytest
import xarray as xr
from matplotlib.text import Text
from pendula.drawing import style

MODULES = [
    *("agreement", "bounds", "chain_drawing", "energy", "growth_rates", "norms", "spacetime"),
    *("stability_chart", "sweeps", "trust"),
    *("lyapunov", "symmetry", "ensembles"),
    *("growth_law", "front", "window_map"),
    *("own_norms", "own_spacetime", "own_sweep"),
]


def draw(module, data):
    return import_module(f"pendula.plots.{module}").draw(data)


@style.styled
def pixels(figure):
    with BytesIO() as file:
        figure.savefig(file, format="png", dpi=50)
        return file.getvalue()


@pytest.fixture(scope="module", params=MODULES)
def plot(request, gathered):
    """Return the module's name, its data, the figure drawn from them, and how that looks."""
    figure = draw(request.param, gathered[request.param])
    return request.param, gathered[request.param], figure, pixels(figure)


def test_every_variable_is_named_and_has_units(plot):
    _, data, _, _ = plot
    for name, variable in data.variables.items():
        assert {"long_name", "units"} <= variable.attrs.keys(), name


def test_saved_data_alone_give_the_same_figure_whatever_the_users_style(plot, tmp_path):
    module, data, _, look = plot
    data.to_netcdf(tmp_path / "data.nc", engine="netcdf4")
    with matplotlib.rc_context({"font.size": 20, "lines.linewidth": 9, "axes.grid": True}):
        assert pixels(draw(module, xr.load_dataset(tmp_path / "data.nc"))) == look
        assert matplotlib.rcParams["font.size"] == 20


def test_text_is_legible_and_everything_is_on_the_page(plot):
    _, _, figure, _ = plot
    assert figure.get_figwidth() in (style.SINGLE, style.DOUBLE)
    shown = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
    assert shown
    assert min(text.get_fontsize() for text in shown) >= 7
    page, needed = figure.bbox_inches, figure.get_tightbbox()
    assert page.x0 <= needed.x0 and needed.x1 <= page.x1
    assert page.y0 <= needed.y0 and needed.y1 <= page.y1
