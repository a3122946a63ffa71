"""Proofs in pictures: the proven bound of an error, its parts, and the error that is known."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pendula.drawing import style

PART_LOOKS = {
    "start": ("#e0a100", "data rounded"),
    "polynomial": ("#16876b", "polynomials of finite order"),
    "rounding": (style.RED, "coefficients rounded"),
    "jumps": ("#7b4fa3", "states rounded"),
    "quadratic": ("#5aa7d6", "quadratic term"),
    "evaluation": ("#7a2e0e", "outputs rounded"),
}

LEAST = 1e-25
"""Smaller errors are not shown."""


def gather_curves(curves: list[xr.Dataset]) -> xr.Dataset:
    """Return bounds and parts of several cases over time, and the known distances up to each."""
    drawn = []
    for curve in curves:
        known = np.fmax.accumulate(curve["reference_distance"].values)  # which falls to no zero
        words = "largest distance of a norm to that of the reference, up to this time"
        one = curve[["bound", "bound_parts"]].assign_attrs(curve.attrs)
        drawn.append(one.assign(distance_so_far=("tau", known, {"long_name": words, "units": "1"})))
    stacked = style.join(drawn, [curve.attrs["case"] for curve in curves], "case")
    for name in drawn[0].data_vars:
        stacked[name].attrs = drawn[0][name].attrs
    return stacked


@style.styled
def draw_curves(data: xr.Dataset) -> Figure:
    """Draw one panel for each case: the bound, its parts, and below it the known distance."""
    figure = style.new_figure(style.DOUBLE, 3.0)
    panels = figure.subplots(1, data.sizes["case"], sharey=True, squeeze=False)[0]
    for letter, axes, name in zip("abcdef", panels, data["case"].values, strict=False):
        case = data.sel(case=name)
        axes.set_yscale("log")
        tau, known = case["tau"], case["distance_so_far"]
        axes.plot(tau, case["bound"], color="0.7", lw=3.2, label="proven bound, the sum of")
        for part, (colour, label) in PART_LOOKS.items():
            values = case["bound_parts"].sel(bound_part=part)
            axes.plot(tau, values.where(values > 0), color=colour, lw=0.9, label=label)
        axes.set_ylim(LEAST, None)
        axes.plot(
            tau, known.where(known > 0), color="black", dashes=(1, 1), lw=1.1,
            label="distance to the reference",
        )  # fmt: skip
        axes.set_title(f"({letter}) {style.name_case(case)}", loc="left")
        axes.set_xlabel(r"$\tau$")
        axes.set_xlim(0, float(data["tau"][-1]))
    panels[0].set_ylabel("distance to the true solution")
    lines = panels[0].get_lines()
    figure.legend(handles=lines, loc="outside upper center", ncols=4, columnspacing=1.6)
    return figure
