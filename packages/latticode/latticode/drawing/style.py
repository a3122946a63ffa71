"""The style of all figures (sizes, fonts, colours), their legends, and how they are saved."""

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from textwrap import fill, wrap
from typing import Any

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure
from matplotlib.image import imsave
from matplotlib.layout_engine import PlaceHolderLayoutEngine
from matplotlib.legend_handler import HandlerTuple
from matplotlib.patheffects import withStroke

from latticode.datasets import complete_or_absent
from latticode.datasets.digest import fingerprint
from latticode.datasets.netcdf import save as save_dataset
from latticode.integrators.methods import NAMED

from .description import as_text, describe
from .light_fonts import light_fonts
from .seals import PIXELS, digest_of_pixels, sealed_pdf

DPI = 300
"""The resolution of the PNG, in pixels per inch."""

LINE_WIDTH = 0.7
"""The width of a line, in points."""

WIDTH = 16.4 / 2.54
"""The width of a figure in inches, equal to the text width of the article."""
NOTE = 110
"""The width of a note below the panels, in characters."""

WITHOUT_INDICES, WITH_INDICES = 8, 10
"""Sizes of text in points. Mathtext draws indices and powers at 0.7 of the size."""
INDEX = re.compile(r"\$[^$]*[_^]")
LETTER, HANDLE = 0.5, 4.8
"""Mean width of a letter, and width of a legend handle with the space around it, relative to the
size of the text."""
MARGIN = 0.55
"""Inches between two panels, for the ticks and labels of the right one."""

ON_COLOURS = {
    "color": "white",
    "lw": 1.0,
    "ls": (0, (3, 1.5)),
    "path_effects": [withStroke(linewidth=2.2, foreground="black")],
}
"""A dashed line that is visible on every colour of a map, and on white in a legend."""

RED, BLUE = "#e8402f", "#123b8c"
"""Two colours that can be distinguished by their lightness in greyscale."""
PALE = {RED: "#f0a79f", BLUE: "#9db2de"}
"""Pale variants, for bands and for curves below others."""

LOOKS = {name: method.look or (f"C{i}", "o") for i, (name, method) in enumerate(NAMED.items())}
"""The colour of each method, and its marker, which distinguishes it in greyscale."""
MARKERS = {name: marker for name, (_, marker) in LOOKS.items()}
COLOURS = {name: colour for name, (colour, _) in LOOKS.items()} | {"l2": RED, "linf": BLUE}


def colour_of(field: int) -> str:
    """Return the colour of a field by its number: 0 is red, 1 is blue."""
    return (RED, BLUE)[field] if field < 2 else f"C{field}"


def symbol(name: str, site: str = "") -> str:
    """Return the name of a field in TeX, without dollar signs, with `site` as an index.

    Text after an underscore becomes an index too. A name is set as text if it is long, if it has
    characters other than letters and digits, or if it has two underscores in a row.

    >>> symbol("u"), symbol("u", "n"), symbol("psi_1", "n"), symbol("u__1", "n")
    ('u', 'u_n', 'psi_{1,n}', '\\\\text{u__1}_n')
    """
    stem, *indices = pieces = name.split("_")
    if len(name) > LONGEST_SYMBOL or not all(
        piece.isalnum() and max(piece) <= LAST_IN_MATHTEXT for piece in pieces
    ):
        stem, indices = rf"\text{{{name}}}", []
    if not indices:
        return f"{stem}_{site}" if site else stem
    return f"{stem}_{{{','.join([*indices, site] if site else indices)}}}"


def plain_text(text: str) -> str:
    """Return a text with escaped dollar signs, which would otherwise begin a formula."""
    return text.replace("$", r"\$")


LONGEST_SYMBOL = 12
"""Largest number of characters in the name of a field that is printed as a symbol."""
LAST_IN_MATHTEXT = "\U0001ffff"
"""The last character that mathtext accepts."""

# start from matplotlib's defaults, because a user's matplotlibrc must not change the figures
_RC = {key: value for key, value in matplotlib.rcParamsDefault.items() if key != "backend"} | {
    "font.family": "DejaVu Sans",
    "font.size": WITHOUT_INDICES,
    "axes.titlesize": "medium",
    "axes.labelsize": WITH_INDICES,
    "legend.fontsize": "medium",
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "lines.linewidth": LINE_WIDTH,
    "legend.frameon": False,
    "legend.handlelength": 2,
    "axes.titley": 1.0,  # otherwise matplotlib measures ticks above the panel for each title
    "pdf.fonttype": 42,  # TrueType: journals reject Type 3
    "ps.fonttype": 42,  # otherwise a font is split into subsets of 256 letters, which takes longer
    "figure.dpi": DPI,
}


@contextmanager
def _style() -> Iterator[None]:
    with matplotlib.rc_context(_RC):
        yield


styled = _style()
"""Decorator for functions that draw: they use this style and leave the caller's unchanged."""


class ShownFigure(Figure):
    """A figure that a notebook displays without pyplot."""

    @styled
    def _repr_png_(self) -> bytes:
        with BytesIO() as file:
            self.savefig(file, format="png")
            return file.getvalue()


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of this size in inches, with constrained layout."""
    figure = ShownFigure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def size_of(*texts: str) -> int:
    """Return the size in points for these texts, WITH_INDICES if one has an index or a power."""
    return WITH_INDICES if any(map(INDEX.search, texts)) else WITHOUT_INDICES


def count_letters(text: str) -> int:
    """Return the approximate width of a text with formulas, in letters."""
    symbols = re.sub(r"\\[a-zA-Z]+", "x", text.replace(r"\text", ""))
    return len(re.sub(r"[${}_^\\]", "", symbols))


def letters_above(axes: Axes, size: float) -> int:
    """Return the approximate number of letters of a size in points that fit above a panel."""
    columns = axes.get_subplotspec().get_gridspec().ncols
    return int(72 * (axes.figure.get_figwidth() / columns - MARGIN) / (LETTER * size))


def set_title(axes: Axes, title: str) -> None:
    """Put a title above a panel, at the left, and enlarge the figure by its additional lines.

    Lines break after commas with two spaces; text without a formula may break at any space.
    """
    size = size_of(title)
    room, lines = letters_above(axes, size), []
    for part in title.split(",  "):
        if lines and count_letters(f"{lines[-1]},  {part}") <= room:
            lines[-1] += f",  {part}"
            continue
        if lines:
            lines[-1] += ","
        lines += [part] if "$" in part else wrap(part, room)
    highest = max(panel.get_title(loc="left").count("\n") for panel in axes.figure.axes)
    more = max(0, len(lines) - 1 - highest)
    axes.figure.set_figheight(axes.figure.get_figheight() + more * 1.2 * size / 72)
    axes.set_title("\n".join(lines), loc="left", fontsize=size)


def count_columns(figure: Figure, labels: Sequence[str], most: int, size: float) -> int:
    """Return the number of columns, at most `most`, of a legend that fits above the panels."""
    widths = [size * (LETTER * count_letters(label) + HANDLE) for label in labels]
    for columns in range(min(most, len(labels)), 1, -1):
        rows = -(-len(labels) // columns)
        starts = range(0, len(labels), rows)
        if sum(max(widths[i : i + rows]) for i in starts) <= 72 * figure.get_figwidth():
            return -(-len(labels) // rows)
    return 1


def name_legend(
    figure: Figure, *panels: Axes, columns: int = 7, fontsize: float | None = None
) -> None:
    """Put one legend for all panels above them, in at most `columns` columns.

    A label of several panels is listed once. Legend lines are thick enough to show their colour.
    """
    named = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            named.setdefault(label, handle)
    if not named:
        return
    size = fontsize or size_of(*named)
    look = {"loc": "outside upper center", "fontsize": size, "columnspacing": 1.2}
    look["ncols"] = count_columns(figure, [*named], columns, size)
    legend = figure.legend(named.values(), named.keys(), **look)
    for line in legend.get_lines():
        line.set_linewidth(max(1.6, line.get_linewidth()))


def legend_above(figure: Figure, handles: Sequence, labels: Sequence[str], **look: Any) -> None:
    """Put a legend above all panels. Handles in a tuple are drawn side by side with one label."""
    side_by_side = {tuple: HandlerTuple(ndivide=None, pad=0.3)}
    figure.legend(handles, labels, loc="outside upper center", handler_map=side_by_side, **look)


def name_units(values: xr.DataArray) -> str:
    """Return the units of a quantity for its axis label, such as " (s)"; "" if it has none."""
    units = values.attrs.get("units", "1")
    return "" if units == "1" else f" ({units})"


def join(
    datasets: list[xr.Dataset], names: list[str], dim: str, attributes: Sequence[str] = ()
) -> xr.Dataset:
    """Return datasets stacked along a new dimension, with `attributes` as variables over it."""
    stacked = xr.concat(
        [data.drop_attrs(deep=False) for data in datasets],
        xr.Variable(dim, names),
        join="outer",
        combine_attrs="override",
        coords="minimal",
        compat="override",
    )
    return stacked.assign(
        {key: (dim, [dataset.attrs[key] for dataset in datasets]) for key in attributes}
    )


@styled
def save(
    figure: Figure,
    data: xr.Dataset,
    png: str | Path,
    pdf: str | Path,
    netcdf: str | Path,
    description: str | Path,
    note: str = "",
) -> None:
    """Write the figure as PNG and PDF, its data, and its description.

    Each file is complete or absent, and has the same bytes every time. `note` is printed below the
    panels. Both pictures contain the fingerprint of the description and a checksum (see `seals`);
    the description contains the digest of the data. A picture of different data is thus detected.
    """
    if note:
        # without a layout engine there is no space for the note except below the left half
        has_layout = not isinstance(figure.get_layout_engine(), PlaceHolderLayoutEngine)
        text = fill(note, NOTE if has_layout else NOTE * 2 // 5)
        figure.supxlabel(text, x=0.5 if has_layout else 0.22, fontsize=7)
    title = f"What the figure {Path(netcdf).stem} shows"
    with (
        complete_or_absent(png) as new_png,
        complete_or_absent(pdf) as new_pdf,
        complete_or_absent(netcdf) as new_netcdf,
        complete_or_absent(description) as new_description,
    ):
        _measure_less(figure)
        # not savefig, which draws the figure twice
        figure.canvas.draw()
        text = as_text(describe(figure, data)) + "\n"
        new_description.write_text(text, encoding="utf-8")
        mark = fingerprint(text)
        pixels, quick = np.asarray(figure.canvas.buffer_rgba()), {"compress_level": 3}
        inside = {"Software": None, "Panels": _panels(figure), "Description": mark}
        inside[PIXELS] = digest_of_pixels(pixels)
        imsave(new_png, pixels, dpi=figure.dpi, metadata=inside, format="png", pil_kwargs=quick)
        figure.set_layout_engine("none")  # the PDF uses the margins that are computed already
        undated = {"CreationDate": None, "Creator": None, "Producer": None}
        with light_fonts(), BytesIO() as drawn:
            FigureCanvasPdf(figure).print_pdf(drawn, metadata={**undated, "Keywords": mark})
            new_pdf.write_bytes(sealed_pdf(drawn.getvalue()))
        save_dataset(new_netcdf, data.assign_attrs(title=title))


def _measure_less(figure: Figure) -> None:
    """Exclude sides of panels without ticks from the layout, because they do not affect it.

    Measuring a side is slow, because matplotlib computes all ticks of its axis again.
    """
    for axes in figure.axes:
        for axis, first, second in ((axes.xaxis, "bottom", "top"), (axes.yaxis, "left", "right")):
            if axis.get_ticks_position() == first:
                axes.spines[second].set_in_layout(False)


def _panels(figure: Figure) -> str:
    """Return left, top, right and bottom of each panel in pixels, for the figure diff."""
    height = figure.bbox.height
    boxes = [axes.get_window_extent() for axes in figure.axes if axes.get_visible()]
    edges = [(box.x0, height - box.y1, box.x1, height - box.y0) for box in boxes]
    return ";".join(" ".join(str(round(edge)) for edge in box) for box in edges)
