"""Theorems 1 to 3 in pictures: what was seen, and how much of the bounds data reach.

The bounds are on P = |A|^2 + |B|^2 in l2.
"""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from pendula.drawing import name_initial

BOUNDS = {
    "theorem_1": (">", "#16876b", "Theorem 1"),
    "theorem_2": ("s", "#e0a100", "Theorem 2"),
    "widened": ("D", "#7a4fa3", "Theorem 2 with bonds"),
    "theorem_3": ("|", style.BLUE, "Theorem 3"),
}
FORMS = {
    "theorem_1": ("theorem_1", "Theorem 1"),
    "theorem_2": ("theorem_2_energy", "Theorem 2,\nby the energy"),
    "theorem_2_ball": ("theorem_2_ball", "Theorem 2,\n$C_0 \\delta$"),
    "theorem_3": ("theorem_3", "Theorem 3"),
}
"""The forms of the bounds: the family of their random data, and their names."""

POWER = r"$P = \|A\|^2 + \|B\|^2$"
CAPTION = (
    "P = ‖A‖² + ‖B‖² in ℓ² and the bounds of Theorems 1 to 3. (a): P at the start, its largest "
    "value in each run, and the bounds that apply to the case; Theorem 2 with bonds also counts "
    "the coupling energy. (b): the largest P divided by its bound, for random initial conditions "
    "(bars) and for a wave on a long chain (blue); dashed: 1. (c): P reached on "
    "N sites at Ω = 0, and its bound by Theorem 3."
)


def gather_bounds(cases, samples, sharpness, growth) -> xr.Dataset:
    """Return cases with their bounds, what data reach, and what grows with the chain."""
    seen = cases[["omega", "initial", "observed", "start", "ratio", *BOUNDS]]
    reached = sharpness[["reached"]].rename(sites="reached_sites")
    chains = growth[["late_power", "constant_n"]].sel(omega=0.0, drop=True)
    chains = chains.rename(sites="grown_sites", member="grown_member")
    drawn = [seen, samples[["worst_sample"]], reached, chains]
    return xr.merge(drawn, combine_attrs="drop_conflicts").assign_attrs(caption=CAPTION)


@style.styled
def draw_bounds(data: xr.Dataset) -> Figure:
    """Draw cases and what the bounds allow above, the growth with N below."""
    figure = style.new_figure(style.WIDTH, 5.2)
    panels = figure.subplot_mosaic("ab;cc", height_ratios=(3, 2))
    cases, forms, growth = panels.values()
    _draw_cases(cases, data)
    _draw_forms(forms, data)
    _draw_growth(growth, data)
    for letter, axes in panels.items():
        axes.annotate(f"({letter})", (0, 1), (-22, 4), "axes fraction", "offset points")
    return figure


def _legend_above(axes: Axes, columns: int) -> None:
    look = {"columnspacing": 0.9, "handlelength": 1.2, "handletextpad": 0.4, "borderaxespad": 0.2}
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=columns, **look)


def _draw_cases(axes: Axes, data: xr.Dataset) -> None:
    rows = np.arange(data.sizes["case"])
    hollow = {"color": "white", "markeredgecolor": "black", "label": "at the start"}
    axes.plot(data["start"], rows, "o", markersize=6, **hollow)
    axes.plot(data["observed"], rows, "o", color=style.RED, markersize=4, label="largest seen")
    for name, (marker, colour, label) in BOUNDS.items():
        bound = data[name].where(np.isfinite(data[name]))
        if bound.notnull().any():
            look = {"color": colour, "label": label, "markersize": 6, "markeredgewidth": 1.5}
            axes.plot(bound, rows, marker, **look)
    axes.set_yticks(rows, list(map(_name, data["omega"], data["initial"])))
    axes.set(ylim=(rows[-1] + 0.5, -0.5), xscale="log", xlabel=POWER)
    axes.xaxis.set_minor_locator(NullLocator())
    _legend_above(axes, 2)


def _name(omega: xr.DataArray, initial: xr.DataArray) -> str:
    return rf"$\Omega = {float(omega):g}$" + "\n" + name_initial(str(initial.values))


def _draw_forms(axes: Axes, data: xr.Dataset) -> None:
    """Draw for each form what random data reach as a bar, and the worst data as marks."""
    rows, sites = np.arange(len(FORMS)), data["reached_sites"].values
    families = [family for family, _ in FORMS.values()]
    drawn = data["worst_sample"].sel(family=families)
    axes.barh(rows, drawn, 0.45, color="0.8", label="random data")
    longest = data["reached"].sel(form=list(FORMS)).isel(reached_sites=-1)
    mark = {"color": style.BLUE, "markeredgewidth": 2}
    axes.plot(longest, rows, "|", **mark, markersize=14)
    axes.plot([], [], "|", **mark, markersize=8, label=f"a wave on {int(sites[-1])} sites")
    axes.axvline(1, color="black", lw=0.8, dashes=(4, 2))
    axes.set_yticks(rows, [words for _, words in FORMS.values()])
    axes.invert_yaxis()
    axes.set(xlim=(0, 1.06), xlabel="largest $P$ / bound")
    _legend_above(axes, 1)


def _draw_growth(axes: Axes, data: xr.Dataset) -> None:
    sites = data["grown_sites"]
    look = {"color": style.BLUE, "lw": 1.2, "dashes": (4, 2)}
    axes.plot(sites, data["constant_n"], label="$C_N$ of Theorem 3", **look)
    mark = {"color": style.RED, "marker": "o", "markersize": 3.5, "linestyle": "none"}
    late, label = data["late_power"], r"$P$ reached at $\Omega = 0$, each run"
    for i, run in enumerate(late.transpose("grown_member", ...)):
        axes.plot(sites, run, **mark, label=label if i == 0 else None)
    axes.set(xscale="log", yscale="log", xlabel="number of sites $N$", ylabel=POWER)
    axes.set_xticks(sites.values, [f"{n:g}" for n in sites.values], minor=False)
    axes.xaxis.set_minor_locator(NullLocator())
    _legend_above(axes, 1)
