"""The figure of a survey: lines against one axis, maps over two axes, or points of members."""

from textwrap import fill

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from latticode.datasets.surveys import TEXTS
from latticode.measures.confidence import mean_limits

from . import style

MOST_PANELS = 4
IN_HEIGHT = 28
"""Largest number of letters in a line of an axis label, written along the height of a panel."""
CAPTION_BY_KIND = {"line": "against {x}", "map": "over {x} and {y}", "points": "of each member"}


def gather_survey(survey: xr.Dataset) -> xr.Dataset:
    """Return the results over the first two axes, at the first value of all further axes."""
    axes = [name for name in survey.dims if name not in ("component", "member")]
    drawn = survey.isel(dict.fromkeys(axes[2:], 0))
    drawn = drawn.drop_vars([name for name in TEXTS if name in drawn])
    kind = ("points", "line", "map")[min(len(axes), 2)]
    x, y = ([_name(survey, name) for name in axes] + ["", ""])[:2]
    title = "; ".join(str(variable.attrs["long_name"]) for variable in drawn.data_vars.values())
    caption = f"A survey: {title}, {CAPTION_BY_KIND[kind].format(x=x, y=y)}."
    if "member" in survey.dims and kind != "points":
        caption += " Means over the ensemble; bars are 95 % confidence intervals."
    if axes[2:]:
        caption += f" Only the first value of {', '.join(axes[2:])} is shown."
    if failed := survey.attrs.get("failed_runs"):
        caption += f" Failed runs ({failed}) are left out."
    return drawn.assign_attrs(caption=caption, kind=kind)


def _name(survey: xr.Dataset, name: str) -> str:
    """Return the long name of an axis, or its name if it has none."""
    return str(survey[name].attrs.get("long_name", name))


@style.styled
def draw_survey(data: xr.Dataset) -> Figure:
    """Draw lines against one axis, maps over two axes, or points for the members."""
    names = list(data.data_vars)[:MOST_PANELS]
    fields = data.sizes["component"] if data.attrs["kind"] == "map" else 1
    figure = style.new_figure(style.WIDTH, 2.6 * len(names))
    grid = figure.subplots(len(names), fields, squeeze=False)
    for row, name in zip(grid, names, strict=True):
        if data.attrs["kind"] == "map":
            _draw_maps(figure, row, data[name])
        else:
            _draw_lines(row[0], data[name])
    return figure


def _draw_lines(axes: Axes, result: xr.DataArray) -> None:
    dims = [name for name in result.dims if name not in ("component", "member")]
    along = dims[0] if dims else "member"
    joined = {"ls": "none", "marker": "."} if along == "member" else {"marker": "."}
    for number, field in enumerate(_fields_of(result)):
        x, look = field[along].values, {**joined, "color": style.colour_of(number)}
        if "member" in field.dims and along != "member":
            limits = [mean_limits(limit) for limit in field.transpose(along, "member").values]
            low, middle, high = np.array(
                [(limit.low, limit.value, limit.high) for limit in limits]
            ).T
            axes.errorbar(x, middle, [middle - low, high - middle], label=_label(field), **look)
        else:
            axes.plot(x, field.values, label=_label(field), **look)
    _name_x(axes, result[along])
    axes.set_ylabel(_axis_label(result))
    if "component" in result.dims and result.sizes["component"] > 1:
        axes.legend()


def _draw_maps(figure: Figure, row: np.ndarray, result: xr.DataArray) -> None:
    fields = _fields_of(result)
    for axes in row[len(fields) :]:
        axes.set_visible(False)
    for axes, field in zip(row, fields, strict=False):
        values = field.mean("member") if "member" in field.dims else field
        x, y = values.dims[:2]
        positions = [_positions(values[name].values) for name in (x, y)]
        image = axes.pcolormesh(*positions, values.values.T, shading="nearest", cmap="viridis")
        _name_x(axes, values[x])
        axes.set_ylabel(fill(str(values[y].attrs.get("long_name", y)), IN_HEIGHT))
        axes.set_title(fill(_label(field), style.letters_above(axes, style.WITHOUT_INDICES)))
        figure.colorbar(image, ax=axes, label=_axis_label(result))


def _fields_of(result: xr.DataArray) -> list[xr.DataArray]:
    if "component" not in result.dims:
        return [result]
    return [result.sel(component=name) for name in result["component"].values]


def _axis_label(result: xr.DataArray) -> str:
    name = str(result.attrs["long_name"]).replace("l-infinity", "ℓ∞").replace("l2", "ℓ²")
    return fill(name, IN_HEIGHT)


def _name_x(axes: Axes, values: xr.DataArray) -> None:
    room = style.letters_above(axes, style.WITH_INDICES)
    axes.set_xlabel(fill(str(values.attrs.get("long_name", values.name)), room))


def _label(field: xr.DataArray) -> str:
    return str(field["component"].item()) if "component" in field.coords else ""


def _positions(values: np.ndarray) -> np.ndarray:
    """Return the values of an axis, or 0, 1, ... if they are not numbers."""
    return values if values.dtype.kind in "iuf" else np.arange(values.size)
