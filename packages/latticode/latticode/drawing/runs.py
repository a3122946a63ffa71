"""Figures of a run, a sweep and a localised state, with all parameters in the titles.

`gather_...` returns the dataset that `draw_...` draws, with a caption. A program that uses the
library can replace the symbols of parameters and fields with a `Naming`.
"""

import json
from collections.abc import Mapping
from textwrap import shorten
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from latticode.equations.ends import ends_of
from latticode.equations.initial_values import read_initial
from latticode.measures.difference import VISIBLE

from . import panels, strips, style
from .strips import NORMS, Strip

FEW = 8
"""Up to this number of half-widths, each has its own tick."""
COLOURS = ("red", "blue")
"""Colours of the first two fields, as named in captions."""
RUNS = [Strip("", ""), Strip("second_", "second run, by another method")]
DIVERGED = f"from here on the runs differ by {100 * VISIBLE:g} %"
LONGEST, LONGEST_FIELDS = 46, 12
"""Largest number of characters of a formula in a title, and of the fields in an axis label."""
NORMS_CAPTION = (
    "Norms of {fields} against τ: ℓ∞ on the left and ℓ² on the right. If a run by another method "
    "differs visibly, a dashed line marks the time, and the other run is shown below."
)
SPACETIME_CAPTION = "Moduli of {fields} over time and sites, from left to right."
VALUES_CAPTION = (
    "Values of {fields} over time and sites, from left to right: red is positive, blue negative."
)
BREATHER_CAPTION = (
    "A localised state of these equations, continued from the site with the largest initial "
    "amplitudes (left), and its Floquet multipliers (right): it is unstable if a multiplier lies "
    "off the circle. A steady state has exponents instead, and is unstable if an exponent lies to "
    "the right of zero."
)
SWEEP_CAPTION = (
    "Norms of {fields} against the half-width M: ℓ∞ on the left and ℓ² on the right. Filled marks "
    "are maxima over {filled}, hollow marks averages over {hollow}."
)


class Naming(NamedTuple):
    """Symbols of parameters and fields in titles."""

    symbols: Mapping[str, str] = {"half_width": "M"}  # symbols in TeX of a dataset's attributes
    fields: tuple[str, ...] = ()  # names of the initial data; if empty, the fields of the run


PLAIN_NAMING = Naming()


def name_parameters(attributes: Mapping, naming: Naming = PLAIN_NAMING) -> str:
    """Return the model, its parameters and the attributes with a symbol, as text for a title."""
    known = {s: attributes[key] for key, s in naming.symbols.items() if key in attributes}
    symbols = ",  ".join(f"${symbol} = {float(value):.4g}$" for symbol, value in known.items())
    if "parameters" not in attributes:
        return symbols
    parameters = json.loads(attributes["parameters"]).items()
    numbers = [f"{key} {value:.4g}" for key, value in parameters if isinstance(value, int | float)]
    text = f"{attributes['model']}{': ' if numbers else ''}{', '.join(numbers)}"
    text = style.plain_text(shorten(text, LONGEST, placeholder=" ..."))
    return ",  ".join([text, *filter(None, [symbols])])


def name_initial(initial: str, fields: tuple[str, ...]) -> str:
    """Return initial data, stored in datasets as {site: [A, B]}, as text for a title."""
    sites = read_initial(initial)
    ((site, values),) = sites.items() if len(sites) == 1 else [(0, ())]
    if len(values) != len(fields):
        return f"data on {len(sites)} site{'s' * (len(sites) > 1)}"
    names = ", ".join(style.symbol(field, f"{{{site}}}") for field in fields)
    numbers = ", ".join(f"{value if value.imag else value.real:g}" for value in values)
    return rf"$({names}) = ({numbers})$"


def name_data(data: xr.Dataset, naming: Naming = PLAIN_NAMING) -> str:
    """Return the initial data of a run, or their number of sites if they do not fit in a title."""
    fields = naming.fields or tuple(data.attrs["fields"].split(", "))
    named = name_initial(data.attrs["initial"], fields)
    return named if len(named) <= LONGEST else "data on 1 site"


def name_data_and_ends(data: xr.Dataset, naming: Naming = PLAIN_NAMING) -> str:
    """Return the initial data and the boundary condition, as text for a title."""
    return f"{name_data(data, naming)},  {ends_of(data.attrs['boundary']).label}"


def gather_norms(run: xr.Dataset, checks: xr.Dataset | None = None) -> xr.Dataset:
    """Return the norms of a trajectory; if `checks` are passed, add the norms of the second run."""
    names = [str(name) for name in run["component"].values]
    coloured = [f"{name} ({colour})" for name, colour in zip(names, COLOURS, strict=False)]
    fields = " and ".join(coloured) if len(names) <= len(COLOURS) else ", ".join(names)
    attributes = {"caption": NORMS_CAPTION.format(fields=fields), "fields": ", ".join(names)}
    drawn = run[list(NORMS)].assign_attrs(attributes)
    if checks is None:
        return drawn
    second = {f"second_{name}": checks[f"second_{name}"] for name in NORMS}
    return drawn.assign(second | {"divergence_time": checks["divergence_time"]})


@style.styled
def draw_norms(data: xr.Dataset, naming: Naming = PLAIN_NAMING) -> Figure:
    """Draw l-infinity at the left and l2 at the right; the first field is red, the second blue.

    The second run is drawn only if the two runs diverge, in strips below the first.
    """
    has_strip = strips.diverges(data)
    figure, (grid,) = strips.draw_cases([data], [RUNS if has_strip else [Strip("", "")]])
    style.set_title(grid[0, 0], name_parameters(data.attrs, naming))
    style.set_title(grid[0, 1], name_data_and_ends(data, naming))
    strips.name_legend(figure, data["component"].values, DIVERGED if has_strip else "")
    return figure


def gather_spacetime(run: xr.Dataset) -> xr.Dataset:
    """Return the values of real fields over the times of the snapshots, otherwise the moduli.

    A run that stores only moduli has no values.
    """
    names = [str(name) for name in run["component"].values]
    signed = "state" in run and "value" in run["part"].values
    caption = VALUES_CAPTION if signed else SPACETIME_CAPTION
    caption = caption.format(fields=", ".join(f"{name}ₙ" for name in names))
    moduli = panels.values_over_time(run) if signed else panels.over_time(run)
    return moduli.assign_attrs(caption=caption, fields=", ".join(names))


@style.styled
def draw_spacetime(data: xr.Dataset, naming: Naming = PLAIN_NAMING) -> Figure:
    """Draw the moduli or values of all fields side by side, with one colour scale."""
    figure = style.new_figure(style.WIDTH, 2.5)
    count = data.sizes["component"]
    row = figure.subplots(1, count, sharex=True, sharey=True, squeeze=False)[0]
    names = [name_parameters(data.attrs, naming), name_data(data, naming), *[""] * count]
    draw = panels.draw_values if "value" in data else panels.draw_moduli
    draw(figure, row, data, names[:count], panels.is_even(data["snapshot_tau"].values))
    for axes in row:
        axes.set_xlabel(r"$\tau$")
    row[0].set_ylabel("site $n$")
    return figure


def gather_breather(checks: xr.Dataset) -> xr.Dataset:
    """Return the variables of the localised state in the checks of a run, with a caption."""
    breather = checks[[name for name in checks.data_vars if name.startswith("breather")]]
    return breather.assign_attrs(caption=BREATHER_CAPTION)


@style.styled
def draw_breather(data: xr.Dataset) -> Figure:
    """Draw the moduli over sites (left), and the multipliers or, if steady, the exponents (right).

    If there is no state, the figure shows the reason.
    """
    figure = style.new_figure(style.WIDTH, 2.7)
    if "breather" not in data:
        reason = data.attrs.get("breather_refusal", "the checks did not search for one")
        figure.text(0.5, 0.5, f"no localised state: {reason}", ha="center")
        return figure
    left, right = figure.subplots(1, 2)
    for i, component in enumerate(data["component"].values):
        look = {"color": style.colour_of(i), "marker": ".", "label": f"${style.symbol(component)}$"}
        left.plot(data["site"], data["breather"].sel(component=component), **look)
    left.set(xlabel="site $n$", ylabel="modulus", ylim=(0, None))
    left.xaxis.get_major_locator().set_params(integer=True)
    style.set_title(left, name_parameters(data.attrs))
    turns = float(data["breather_frequency"]) != 0.0
    quantity = "multipliers" if turns else "exponents"
    points = data[f"breather_{quantity}"].values
    right.plot(*points, color="black", marker=".", linestyle="none")
    if turns:
        right.add_patch(Circle((0, 0), 1.0, fill=False, color="grey", lw=0.5))
        right.set_aspect("equal", "datalim")
    right.set(xlabel=f"real part of {quantity}", ylabel="imaginary part")
    style.name_legend(figure, left)
    return figure


def gather_sweep(
    sweep: xr.Dataset, max_window: str | None = None, mean_window: str | None = None
) -> xr.Dataset:
    """Return the maxima of the norms of all fields over one window, and their means over another.

    Both windows default to the first of the sweep.
    """
    first = str(sweep["window"].values[0])
    windows = max_window or first, mean_window or first
    readings = {"max": ("max", windows[0]), "mean": ("mean", windows[1])}
    fields = ", ".join(str(name) for name in sweep["quantity"].values if name != "pair")
    caption = SWEEP_CAPTION.format(fields=fields, filled=windows[0], hollow=windows[1])
    attributes = {**sweep.attrs, "caption": caption, "fields": fields}
    return panels.join_sweeps({"sweep": sweep}, readings, list(NORMS)).assign_attrs(attributes)


@style.styled
def draw_sweep(data: xr.Dataset, naming: Naming = PLAIN_NAMING) -> Figure:
    """Draw l-infinity (left) as blue squares and l2 (right) as red dots; means are hollow."""
    figure = style.new_figure(style.WIDTH, 2.7)
    row = figure.subplots(1, 2, sharex=True)
    fields = [style.symbol(field) for field in data.attrs["fields"].split(", ")]
    label = f"$({', '.join(fields)})$" if len(fields) > 1 else f"${fields[0]}$"
    if style.count_letters(label) > LONGEST_FIELDS:
        label = "all fields"
    for axes, name in zip(row, NORMS, strict=True):
        panel = data.isel(panel=0).drop_vars([norm for norm in NORMS if norm != name])
        panels.draw_sweep(axes, panel, label)
    _mark_widths(row[0], data["half_width"].values)
    style.set_title(row[0], name_parameters(data.attrs, naming))
    style.set_title(row[1], name_data_and_ends(data, naming))
    style.name_legend(figure, *row)
    return figure


def _mark_widths(axes: Axes, widths: np.ndarray) -> None:
    """Put ticks at the half-widths if they are few, and use a linear axis if one is zero."""
    if widths.min() == 0:
        axes.set_xscale("linear")
    if len(widths) <= FEW or widths.min() == 0:
        axes.set_xticks(widths[:: -(-len(widths) // FEW)])
