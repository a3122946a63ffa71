"""A description of a figure as JSON text, saved next to the picture.

Pixels do not show which of two curves is A, and the pixels of letters depend on the font library.
The description has all texts of the figure, the look of each curve, and the rows of the data that
it shows. A figure diff can compare it word by word on any machine.

Numbers are rounded to DIGITS digits, which is finer than a pixel and coarser than the differences
between processors. Positions on the page are omitted, because they depend on the width of letters.
The position of an annotation is a point in its panel, or an offset in points from such a point.
"""

import json
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import Collection, FillBetweenPolyCollection, QuadMesh
from matplotlib.colorizer import ColorizingArtist
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Annotation, Text

from latticode.datasets.digest import digest

from .shown_data import Rows

DIGITS = 6
"""Significant digits of limits, positions and ranges: a panel is about 2000 pixels wide."""
LINE = 220
"""Length in characters up to which a JSON value is one line, enough for any curve or text."""


def describe(figure: Figure, data: xr.Dataset) -> dict[str, Any]:
    """Return the description of a drawn figure, with the digest of its data."""
    mapped = (artist for axes in figure.axes for artist in (*axes.images, *axes.collections))
    bars = {artist.colorbar.ax for artist in mapped if getattr(artist, "colorbar", None)}
    rows = Rows(data)
    sections = {
        "data": digest(data),
        "size_in_inches": [_round(length) for length in figure.get_size_inches()],
        "title": figure.get_suptitle(),
        "legends": [_legend(legend) for legend in figure.legends],
        "texts": [_text(text) for text in figure.texts if text.get_text() != figure.get_suptitle()],
        "panels": [_panel(axes, axes in bars, rows) for axes in figure.axes if axes.get_visible()],
    }
    return _without_empty(sections)


def _without_empty(entries: dict[str, Any]) -> dict[str, Any]:
    return {name: entry for name, entry in entries.items() if entry not in ("", [])}


def as_text(description: Any, indent: int = 0) -> str:
    """Return a description as JSON, with one line for each curve, text or axis."""
    line = json.dumps(description, ensure_ascii=False, allow_nan=False)
    if len(line) + indent <= LINE or not isinstance(description, dict | list):
        return line
    if isinstance(description, dict):
        lines = [f'"{key}": {as_text(value, indent + 1)}' for key, value in description.items()]
    else:
        lines = [as_text(entry, indent + 1) for entry in description]
    opening, closing = ("{", "}") if isinstance(description, dict) else ("[", "]")
    margin = " " * indent
    inner = f",\n{margin} ".join(lines)
    return f"{opening}\n{margin} {inner}\n{margin}{closing}"


def _panel(axes: Axes, is_bar: bool, rows: Rows) -> dict[str, Any]:
    titles = [axes.get_title(loc) for loc in ("left", "center", "right")]
    grid = axes.get_subplotspec()
    drawn = {
        "title": " | ".join(filter(None, titles)),
        "kind": "colour bar" if is_bar else "panel",
        # left, bottom, right and top in the grid, before the layout makes room for text
        "place_in_grid": [round(x, 3) for x in grid.get_position(axes.figure).extents]
        if grid
        else [],
    }
    if axes.axison:
        drawn |= {"x": _axis(axes.xaxis), "y": _axis(axes.yaxis)}
    legend = axes.get_legend()
    drawn |= {
        "legends": [_legend(legend)] if legend else [],
        "curves": [_curve(line, rows) for line in _seen(axes.lines)],
        "areas": [_area(area, rows) for area in _seen(axes.collections)],
        "images": [_mapped(image, rows) for image in _seen(axes.images)],
        "shapes": [_shape(patch) for patch in _seen(axes.patches)],
        "texts": [_text(text) for text in _seen(axes.texts)],
    }
    return _without_empty(drawn)


def _axis(axis: Axis) -> dict[str, Any]:
    first, last = sorted(axis.get_view_interval())
    ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
    visible = {
        tick.get_loc(): tick.label1.get_text() or tick.label2.get_text()
        for tick in ticks
        if tick.label1.get_visible() or tick.label2.get_visible()
    }
    entries = {
        "label": axis.get_label_text(),
        "scale": axis.get_scale(),
        "limits": [_round(limit) for limit in axis.get_view_interval()],
        "ticks": [visible[loc] for loc in sorted(visible) if first <= loc <= last and visible[loc]],
    }
    return _without_empty(entries)


def _legend(legend: Legend) -> dict[str, Any]:
    pairs = zip(legend.get_texts(), legend.legend_handles, strict=True)
    entries = [{"text": text.get_text()} | _look(handle) for text, handle in pairs]
    return _without_empty({"title": legend.get_title().get_text(), "entries": entries})


def _seen(artists: Iterable[Artist]) -> list[Artist]:
    """Return the visible artists."""
    return [artist for artist in artists if artist.get_visible()]


def _curve(line: Line2D, rows: Rows) -> dict[str, Any]:
    x, y = (np.ma.filled(np.asarray(values, float), np.nan) for values in line.get_data())
    is_finite = np.isfinite(x) & np.isfinite(y)
    described = _named(line) | _look(line) | {"points": int(is_finite.sum())}
    of_rows = {"shows": rows.of_curve(x, y) or rows.of_curve(x[is_finite], y[is_finite])}
    more = _without_empty(of_rows | _cut(line, x, y))
    return described | more | _ranges(x[is_finite], y[is_finite])


def _cut(line: Line2D, x: np.ndarray, y: np.ndarray) -> dict[str, str]:
    """Return, for each axis, whether a curve leaves its limits below, above, or both."""
    if line.get_transform() != line.axes.transData:
        return {}
    sides = {}
    for name, values, axis in (("x", x, line.axes.xaxis), ("y", y, line.axes.yaxis)):
        first, last = sorted(axis.get_view_interval())
        beyond = {"below": (values < first).any(), "above": (values > last).any()}
        sides |= {f"{name} leaves": " and ".join(side for side, is_out in beyond.items() if is_out)}
    return sides


def _area(area: Collection, rows: Rows) -> dict[str, Any]:
    """Describe a band, bars or a colour map: the colours and the ranges of x and y."""
    if isinstance(area, QuadMesh):
        corners = area.get_coordinates().reshape(-1, 2)
        return _named(area) | _mapped(area, rows) | _ranges(*corners.T)
    outlines = [path.vertices for path in area.get_paths()]
    corners = np.concatenate([np.empty((0, 2)), *outlines])
    rows_shown = {}
    if isinstance(area, FillBetweenPolyCollection) and len(outlines) == 1:
        length = (len(corners) - 3) // 2  # the outline follows one edge, then returns on the other
        edges = corners[1 : length + 1], corners[length + 2 : -1][::-1]
        rows_shown = {
            "shows": " and ".join(filter(None, (rows.of_curve(*edge.T) for edge in edges)))
        }
    corners = corners[np.isfinite(corners).all(axis=1)]
    described = _named(area) | _look(area) | {"points": len(corners)} | _without_empty(rows_shown)
    return described | _ranges(*corners.T)


def _shape(patch: Patch) -> dict[str, Any]:
    outline = patch.get_patch_transform().transform_path(patch.get_path()).vertices
    return _named(patch) | _look(patch) | _ranges(*outline.T)


def _mapped(image: ColorizingArtist, rows: Rows) -> dict[str, Any]:
    """Describe an image: its shape, its limits, and the first, middle and last colour of its map.

    The colours reveal a reversed map.
    """
    values = np.ma.filled(np.ma.asarray(image.get_array(), float), np.nan)
    ends = [to_hex(image.cmap(share)) for share in (0.0, 0.5, 1.0)]
    described = {
        "colour_map": " ".join([image.cmap.name, *ends]),
        "scale": type(image.norm).__name__,
        "limits": [_round(image.norm.vmin), _round(image.norm.vmax)],
        "shape": list(values.shape),
        "shows": rows.name(values),
    }
    if isinstance(image, AxesImage):
        described["extent"] = [_round(edge) for edge in image.get_extent()]
    return _without_empty(described)


def _named(artist: Artist) -> dict[str, str]:
    """Return the label of the artist in a legend; matplotlib's default labels begin with _."""
    label = str(artist.get_label())
    return {} if not label or label.startswith("_") else {"label": label}


def _look(artist: Artist) -> dict[str, Any]:
    """Return the colours of an artist, and the line style and marker if it is a curve."""
    if isinstance(artist, Line2D):
        look = {"colour": _colours([artist.get_color()], artist), "line": artist.get_linestyle()}
        if look["line"] != "None":
            look["width"] = _round(artist.get_linewidth())
        if (marker := str(artist.get_marker())) not in ("None", ""):
            face = _colours([artist.get_markerfacecolor()], artist)
            look |= {"marker": marker, "size": _round(artist.get_markersize()), "face": face}
        return look
    faces, edges = (
        np.reshape(c, (-1, 4)) for c in (artist.get_facecolor(), artist.get_edgecolor())
    )
    return {
        "kind": type(artist).__name__,
        "colour": _colours(faces, artist),
        "edge": _colours(edges, artist),
    }


def _colours(colours: Iterable, artist: Artist) -> str:
    """Return the different colours as #rrggbb, each followed by its opacity if that is below 1."""
    alpha = artist.get_alpha()
    rgba = (to_rgba(colour, alpha) for colour in colours)
    names = [to_hex(colour) + (f" {colour[3]:.3g}" if colour[3] < 1 else "") for colour in rgba]
    return ", ".join(dict.fromkeys(names))


def _text(text: Text) -> dict[str, Any]:
    """Describe a text: its colour, its position, and the coordinates of that position."""
    described = {"text": text.get_text(), "colour": to_hex(text.get_color())}
    if isinstance(text, Annotation):
        described |= {"points_at": [_round(x) for x in text.xy], "of": str(text.xycoords)}
        off = str(text.anncoords)
    elif text.axes is None:
        off = "figure fraction"
    else:
        frames = {"data": text.axes.transData, "axes fraction": text.axes.transAxes}
        off = next((k for k, frame in frames.items() if frame is text.get_transform()), "other")
    return described | {"stands_at": [_round(x) for x in text.get_position()], "off": off}


def _ranges(x: np.ndarray, y: np.ndarray) -> dict[str, list[float]]:
    ends = {"x": x, "y": y}
    return {
        name: [_round(values.min()), _round(values.max())]
        for name, values in ends.items()
        if values.size
    }


def _round(number: float) -> float:
    return float(f"{number:.{DIGITS}g}") + 0.0  # no negative zero
