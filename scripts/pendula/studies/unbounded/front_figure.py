"""The front on the infinite chain in pictures: its speed, and the bulk behind it."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style
from pendula.numerics.elementary import geometric, interpolated, log

LATE = 10
"""The lines of the delay are laid through so many of the last points of the front's way."""

MILLI = 1e3
ASIDE = 0.07
"""Points at one Omega stand beside each other by so much."""

GREEN = "#16876b"
BULK_LOOK = {"color": style.RED, "lw": 1.1, "label": "behind the front"}
THERMAL_LOOK = {"color": "black", "lw": 0.9, "ls": "--", "label": "thermal"}
DOTS = {"color": style.RED, "marker": "o", "ms": 3.0, "lw": 0, "elinewidth": 0.9, "capsize": 1.5}
RINGS = {**DOTS, "color": style.BLUE, "marker": "s", "mfc": "white", "mew": 0.8}
TERM_LOOKS = {
    "cubic": (style.RED, "-", "cubic"),
    "detuning": ("#b07800", "-.", "detuning"),
    "drive": (GREEN, "--", "drive"),
    "bonds": (style.BLUE, ":", "bonds"),
}


def gather_front(front: xr.Dataset) -> xr.Dataset:
    """Return what `measured.measure_front` has made."""
    return front


@style.styled
def draw_front(data: xr.Dataset) -> Figure:
    """Draw the front (its way and its speed), the power of the bulk, and the state it is in."""
    figure = style.new_figure(style.DOUBLE, 6.2)
    parts = (
        *(_draw_positions, _draw_speeds, _draw_differences),
        *(_draw_way, _draw_powers, _draw_ratios),
        *(_draw_terms, _draw_spectrum, _draw_distribution),
    )
    grid = figure.subplots(3, 3).ravel()
    for axes, part, letter in zip(grid, parts, "abcdefghi", strict=True):
        part(axes, data)
        axes.set_title(f"({letter})", loc="left", fontsize=8)
    return figure


def _draw_positions(axes: Axes, data: xr.Dataset) -> None:
    omegas, tau = data["omega"].values, data["piece_tau"]
    for omega, colour in ((omegas[len(omegas) // 2], style.RED), (omegas[0], GREEN)):
        label = rf"$\Omega = {omega:g}$"
        axes.plot(tau, data["front"].sel(omega=omega), color=colour, lw=1.4, label=label)
        speed = interpolated(omega, data["line_omega"].values, data["line_speed"].values)
        ends = np.array([0.0, float(tau[-1])])
        axes.plot(ends, speed * ends, color="black", lw=0.7, ls="--")
    axes.lines[-1].set_label(r"$v^*\tau$")
    shown = data["large_tau"].values <= float(tau[-1])
    large = data["large_tau"].values[shown], data["large_front"].values[shown]
    label = rf"$\Omega = {float(data.attrs['large_omega']):g}$, large"
    axes.plot(*large, color=style.BLUE, lw=1.1, label=label)
    axes.set(xlabel=r"$\tau$", ylabel="site of the front")
    _end_above(axes, 1.9 * float(data["front"].max()))
    axes.legend(loc="upper left", handlelength=1.4)


def _end_above(axes: Axes, top: float, bottom: float | None = None) -> None:
    """Let an axis end at `top`, unless nothing is drawn since the data have no front."""
    if np.isfinite(top):
        axes.set_ylim(bottom, top)


def _unstable(axes: Axes, data: xr.Dataset) -> tuple[float, float]:
    """Shade the Omega at which the chain at rest is unstable; return their ends."""
    low, high = -2 * data.attrs["gamma"], 2 * data.attrs["gamma"] + 4 * data.attrs["epsilon"]
    axes.axvspan(low, high, color="0.92", zorder=0)
    axes.set_xlabel(r"$\Omega$")
    return low, high


def _draw_speeds(axes: Axes, data: xr.Dataset) -> None:
    """Draw the speeds; outside of the unstable band the line is no speed of a front."""
    low, high = _unstable(axes, data)
    line, inside = data["line_speed"], (data["line_omega"] >= low) & (data["line_omega"] <= high)
    axes.plot(data["line_omega"], line.where(inside), color="black", lw=0.9, label="linear front")
    look = {"color": "0.4", "lw": 0.9, "ls": (0, (3, 1.5))}
    axes.plot(data["line_omega"], line.where(~inside), label="group velocity", **look)
    limits = data["corrected_speed_error"]
    axes.errorbar(data["omega"], data["corrected_speed"], limits, label="measured", **DOTS)
    axes.set_ylabel(r"speed (sites per unit of $\tau$)")
    axes.legend(loc="lower center", handlelength=1.4)


def _draw_differences(axes: Axes, data: xr.Dataset) -> None:
    """Draw what speeds are off linear spreading, before and after the delay is added back."""
    _unstable(axes, data)
    axes.axhline(0.0, color="black", lw=0.8)
    series = (("speed", "as it is", RINGS, -ASIDE), ("corrected_speed", "corrected", DOTS, ASIDE))
    ends = []
    for name, label, look, aside in series:
        off = MILLI * (data[name] - data["predicted_speed"])
        limits = MILLI * data[f"{name}_error"]
        axes.errorbar(data["omega"] + aside, off, limits, label=label, **look)
        ends += [float((off - limits).min()), float((off + limits).max())]
    span = max(ends) - min(ends)
    _end_above(axes, max(ends) + 0.25 * span, min(ends) - 0.05 * span)
    axes.set_ylabel(r"$10^3$ (speed $- v^*)$")
    axes.legend(loc="upper center", ncols=2, handlelength=1.2, columnspacing=1.0)


def _draw_way(axes: Axes, data: xr.Dataset) -> None:
    tau = data["way_tau"].values
    axes.plot(tau, data["behind"], "o", color=style.RED, ms=2.5, label="measured")
    fine = geometric(tau[0], tau[-1], 200)
    delay, rest = float(data["delay"]), float(data["front_rest"])
    looks = (("--", 0.0, r"$-\frac{3}{2\lambda}\,\ln\tau$"), ("-", rest, "and the next term"))
    for dashes, next_term, label in looks:
        at, line = (-delay * log(t) - next_term / np.sqrt(t) for t in (tau[-LATE:], fine))
        line += float(data["behind"][-LATE:].mean()) - at.mean()
        axes.plot(fine, line, color="black", lw=0.9, ls=dashes, label=label)
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel(rf"front $- v^*\tau$ (sites), $\Omega = {data.attrs['omega']:g}$")
    _end_above(axes, float(data["behind"].max()) + 4.8)
    axes.legend(loc="upper right", handlelength=1.6)


def _draw_powers(axes: Axes, data: xr.Dataset) -> None:
    """Draw the mean power of the bulk over Omega beside that of the thermal state."""
    axes.plot(data["thermal_omega"], data["thermal_power"], **THERMAL_LOOK)
    axes.errorbar(data["omega"], data["mean_power"], data["mean_power_error"], label="bulk", **DOTS)
    axes.set_ylim(bottom=0)
    axes.set(xlabel=r"$\Omega$", ylabel="mean power $P$ of a site")
    axes.legend(loc="upper right")


def _draw_ratios(axes: Axes, data: xr.Dataset) -> None:
    """Draw the power of the bulk over that of the thermal state, measured in two ways."""
    axes.axhline(1.0, **THERMAL_LOOK)
    series = (
        ("mean_power", "mean", DOTS, ASIDE),
        ("slope_power", r"slope of $\ell^2$ squared", RINGS, -ASIDE),
    )
    for name, label, look, aside in series:
        ratio = data[name] / data["expected_power"]
        limits = data[f"{name}_error"] / data["expected_power"]
        limits = limits.where(np.isfinite(limits))  # one run shows no scatter
        axes.errorbar(data["omega"] + aside, ratio, limits, label=label, **look)
    axes.set(xlabel=r"$\Omega$", ylabel="power over thermal power")
    axes.legend(loc="lower left", handlelength=1.2)


def _draw_terms(axes: Axes, data: xr.Dataset) -> None:
    """Draw the terms of the energy per site against the distance to the front."""
    for term, (colour, dashes, label) in TERM_LOOKS.items():
        values = data["mean_terms"].values[list(data["term"].values).index(term)]
        if np.any(values):
            axes.plot(data["scaled_site"], values, color=colour, ls=dashes, lw=1.1, label=label)
    total = data["mean_terms"].sum("term")
    axes.plot(data["scaled_site"], total, color="black", lw=1.1, label="sum")
    _end_above(axes, 1.75 * float(data["mean_terms"].max()))
    axes.set(xlabel="site over that of the front", ylabel="energy per site")
    axes.legend(loc="upper right", ncols=2, columnspacing=1.0, handlelength=1.6)


def _draw_spectrum(axes: Axes, data: xr.Dataset) -> None:
    """Draw the spectrum behind the front beside that of the thermal state."""
    for name, look in (("spectrum", BULK_LOOK), ("thermal_spectrum", THERMAL_LOOK)):
        values = data[name].values
        both = 0.5 * (values + np.roll(values[::-1], 1))  # k and -k are alike
        half = slice(0, len(values) // 2 + 1)
        axes.plot(data["wave_number"][half] / np.pi, both[half], **look)
    _end_above(axes, 1.45 * float(data["spectrum"].max()), 0.0)
    axes.set(
        xlabel=r"wave number $k / \pi$",
        ylabel=rf"mean $|A(k)|^2$, $\Omega = {data.attrs['omega']:g}$",
    )
    axes.legend(loc="upper left")


def _draw_distribution(axes: Axes, data: xr.Dataset) -> None:
    """Draw the distribution of the moduli beside that of the thermal state."""
    measured = data["density"].where(data["density"] > 0)
    thermal = data["thermal_density"].where(data["thermal_density"] > 0)
    axes.plot(data["modulus"], measured, **BULK_LOOK)
    axes.plot(data["thermal_modulus"], thermal, **THERMAL_LOOK)
    axes.set_yscale("log")
    axes.set_xlim(0, 1.02 * float(data["modulus"].max()))
    _end_above(axes, 20.0 * float(measured.max()), 0.5 * float(measured.min()))
    axes.set(
        xlabel="modulus $|A_n|$, $|B_n|$",
        ylabel=rf"density of the moduli, $\Omega = {data.attrs['omega']:g}$",
    )
    axes.legend(loc="upper right")
