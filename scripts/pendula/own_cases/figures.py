"""Figures of a user's cases and sweeps: like the paper's, with every parameter in the titles."""

import json
from collections.abc import Mapping
from textwrap import shorten

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import read, save
from latticode.drawing import panels, strips, style
from latticode.drawing.strips import NORMS, Strip
from latticode.equations.ends import ends_of
from latticode.measures.difference import VISIBLE
from latticode.simulation.problem import read_initial
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from pendula.drawing import name_initial
from pendula.models.pendula import frequency
from pendula.problem import PENDULA

from .checks import check_bounds, check_sweep

FEW = 8
"""Ticks for so many half-widths fit below a panel."""

COLOURS = ("red", "blue")
RUNS = [Strip("", ""), Strip("second_", "second run, by another method")]
DIVERGED = f"from here on the runs differ by {100 * VISIBLE:g} %"
LONGEST = 46
"""A formula with more characters leaves no room for the rest of a title."""
EIGHT = 8.0
"""Outputs in a period of the pendula that show how they swing."""
NORMS_CAPTION = (
    "Norms of {fields} against τ: ℓ∞ on the left and ℓ² on the right. Where a run by another "
    "method differs visibly, a dashed line marks the time and the other run is shown below."
)
FEW_OUTPUTS = (
    " There are fewer than eight outputs in a period of the pendula: use the upper edge of the "
    "curves, or give a shorter output_step."
)
SPACETIME_CAPTION = "Moduli of {fields} over time and sites, from left to right."
SWING_CAPTION = (
    "Amplitudes √(x² + (dx/dt / ω)²) of the angles over time and sites: xₙ on the left and yₙ on "
    "the right."
)
BREATHER_CAPTION = (
    "A localised state of these equations, continued from the site where the initial amplitudes "
    "are largest (left), and its Floquet multipliers (right): it is unstable where one lies off "
    "the circle. A steady state has exponents instead, and is unstable where one lies to the "
    "right of zero."
)
SWEEP_CAPTION = (
    "Norms of {fields} against the half-width M: ℓ∞ on the left and ℓ² on the right. Filled marks "
    "are maxima over {filled}, hollow marks averages over {hollow}."
)


def name_parameters(attributes: Mapping) -> str:
    """Return the constants of the equations, and the half-width where there is only one."""
    if "model_text" in attributes:
        given = json.loads(attributes["parameters"]).items()
        numbers = ", ".join(f"{k} {v:.4g}" for k, v in given if isinstance(v, int | float))
        return shorten(f"{attributes['model']}: {numbers}", LONGEST, placeholder=" ...")
    symbols = {"omega": r"\Omega", "gamma": r"\gamma", "epsilon": r"\epsilon", "half_width": "M"}
    symbols |= {"mu": r"\mu"}
    known = {symbol: attributes[key] for key, symbol in symbols.items() if key in attributes}
    return ",  ".join(f"${symbol} = {float(value):.4g}$" for symbol, value in known.items())


def name_data(attributes: Mapping) -> str:
    """Return the initial data, or the number of sites if they do not fit into a title."""
    if "model_text" in attributes:
        count = len(read_initial(attributes["initial"]))
        return f"data on {count} site{'s' * (count > 1)}"
    named = name_initial(attributes["initial"])
    return named if len(named) <= LONGEST else "data on 1 site"


def name_data_and_ends(attributes: Mapping) -> str:
    """Return the initial data and the kind of ends."""
    return f"{name_data(attributes)},  {ends_of(attributes['boundary']).label}"


def gather_norms(run: xr.Dataset, checks: xr.Dataset | None = None) -> xr.Dataset:
    """Return the norms of a trajectory, beside the second run that its checks hold."""
    drawn = run[["linf", "l2"]].assign_attrs(caption=_caption_of_norms(run))
    if checks is None:
        return drawn
    second = {f"second_{name}": checks[f"second_{name}"] for name in NORMS}
    return drawn.assign(second | {"divergence_time": checks["divergence_time"]})


def _caption_of_norms(run: xr.Dataset) -> str:
    names, about = [str(name) for name in run["component"].values], run.attrs
    colours = zip(names, COLOURS, strict=True) if names in (["A", "B"], ["x", "y"]) else ()
    fields = " and ".join(f"{name} ({colour})" for name, colour in colours) or ", ".join(names)
    caption = NORMS_CAPTION.format(fields=fields)
    if about.get("model") != PENDULA:
        return caption
    period = np.pi * about["mu"] ** 2 / frequency(about["omega"], about["mu"])
    return caption + FEW_OUTPUTS * bool(about["output_step"] > period / EIGHT)


@style.styled
def draw_norms(data: xr.Dataset) -> Figure:
    """Draw l-infinity left and l2 right, A red and B blue.

    Where the two runs diverge the second has strips of its own below; elsewhere it is not drawn.
    """
    parts = strips.diverges(data)
    figure, (grid,) = strips.draw_cases([data], [RUNS if parts else [Strip("", "")]])
    grid[0, 0].set_title(name_parameters(data.attrs), loc="left")
    grid[0, 1].set_title(name_data_and_ends(data.attrs), loc="left")
    strips.name_legend(figure, data["component"].values, DIVERGED if parts else "")
    return figure


def gather_spacetime(run: xr.Dataset) -> xr.Dataset:
    """Return the moduli of a trajectory over the times of its snapshots."""
    names = map(str, run["component"].values)
    caption = SPACETIME_CAPTION.format(fields=", ".join(f"{name}ₙ" for name in names))
    of_pendula = run.attrs.get("model") == PENDULA
    return panels.over_time(run).assign_attrs(caption=SWING_CAPTION if of_pendula else caption)


@style.styled
def draw_spacetime(data: xr.Dataset) -> Figure:
    """Draw |A_n| left and |B_n| right, or all fields of a model, on one scale of colours."""
    figure = style.new_figure(style.WIDTH, 2.5)
    count = data.sizes["component"]
    row = figure.subplots(1, count, sharex=True, sharey=True, squeeze=False)[0]
    names = [name_parameters(data.attrs), name_data(data.attrs), *[""] * count]
    panels.draw_moduli(figure, row, data, names[:count])
    for axes in row:
        axes.set_xlabel(r"$\tau$")
    row[0].set_ylabel("site $n$")
    return figure


def gather_breather(checks: xr.Dataset) -> xr.Dataset:
    """Return the localised state that the checks of a model of one's own hold, if they hold one."""
    shown = checks[[name for name in checks.data_vars if name.startswith("breather")]]
    return shown.assign_attrs(caption=BREATHER_CAPTION)


@style.styled
def draw_breather(data: xr.Dataset) -> Figure:
    """Draw moduli over sites left; right the multipliers, or the exponents of a steady state."""
    figure = style.new_figure(style.WIDTH, 2.7)
    if "breather" not in data:
        reason = data.attrs.get("breather_refusal", "this is looked for in models of one's own")
        figure.text(0.5, 0.5, f"no localised state: {reason}", ha="center")
        return figure
    left, right = figure.subplots(1, 2)
    for i, one in enumerate(data["component"].values):
        look = {"color": style.colour_of(i), "marker": ".", "label": f"${one}$"}
        left.plot(data["site"], data["breather"].sel(component=one), **look)
    left.set(xlabel="site $n$", ylabel="modulus", ylim=(0, None))
    left.xaxis.get_major_locator().set_params(integer=True)
    left.set_title(name_parameters(data.attrs), loc="left")
    turns = float(data["breather_frequency"]) != 0.0
    what = "multipliers" if turns else "exponents"
    points = data[f"breather_{what}"].values
    right.plot(*points, color="black", marker=".", linestyle="none")
    if turns:
        right.add_patch(Circle((0, 0), 1.0, fill=False, color="grey", lw=0.5))
        right.set_aspect("equal", "datalim")
    right.set(xlabel=f"real part of {what}", ylabel="imaginary part")
    style.name_legend(figure, left)
    return figure


def gather_sweep(
    sweep: xr.Dataset, max_window: str | None = None, mean_window: str | None = None
) -> xr.Dataset:
    """Return the pair's maximum over one window of time and its mean over another.

    Both are taken over the sweep's first window where none is given.
    """
    first = str(sweep["window"].values[0])
    windows = max_window or first, mean_window or first
    readings = {"max": ("max", windows[0]), "mean": ("mean", windows[1])}
    drawn = panels.join_sweeps({"sweep": sweep}, readings, list(NORMS)).assign_attrs(sweep.attrs)
    names = [str(name) for name in sweep["quantity"].values if name != "pair"]
    fields = "all fields" if "model_text" in sweep.attrs else f"the pair ({', '.join(names)})"
    caption = SWEEP_CAPTION.format(fields=fields, filled=windows[0], hollow=windows[1])
    return drawn.assign_attrs(caption=caption)


@style.styled
def draw_sweep(data: xr.Dataset) -> Figure:
    """Draw l-infinity left, blue squares, and l2 right, red dots; means are hollow."""
    figure = style.new_figure(style.WIDTH, 2.7)
    row = figure.subplots(1, 2, sharex=True)
    pair = "$(x, y)$" if data.attrs.get("model") == PENDULA else "$(A, B)$"
    fields = "all fields" if "model_text" in data.attrs else pair
    for axes, name in zip(row, NORMS, strict=True):
        panels.draw_sweep(
            axes, data.isel(panel=0).drop_vars([n for n in NORMS if n != name]), fields
        )
    _mark_widths(row[0], data["half_width"].values)
    row[0].set_title(name_parameters(data.attrs), loc="left")
    row[1].set_title(name_data_and_ends(data.attrs), loc="left")
    style.name_legend(figure, *row)
    return figure


def _mark_widths(axes: Axes, widths: np.ndarray) -> None:
    """Mark the half-widths themselves where they are few; a logarithm has no place for zero."""
    if widths.min() == 0:
        axes.set_xscale("linear")
    if len(widths) <= FEW or widths.min() == 0:
        axes.set_xticks(widths[:: -(-len(widths) // FEW)])


def draw_with_checks(
    sweep: str, name: str, text_window: str, caption_window: str, figure: list[str], checks: str
) -> None:
    """Draw the maximum over one window and the mean over another; check the norms by `name`.

    `figure` names the files of the figure: PNG, PDF, data, description.
    """
    swept = read(sweep)
    drawn = gather_sweep(swept, text_window, caption_window)
    style.save(draw_sweep(drawn), drawn, *figure)
    if swept.attrs.get("model") == PENDULA:
        save(checks, check_sweep(name, swept))
    elif "model_text" in swept.attrs:
        save(checks, xr.Dataset(attrs={"case": name}))
    else:
        save(checks, check_bounds(name, swept))
