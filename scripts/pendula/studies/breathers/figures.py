"""Breathers in pictures: families and their growth, sensitivity to data; not the maps of fates."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.transforms import offset_copy

from pendula.drawing import style

FAMILY_LOOKS = {
    "A only": (style.RED, "o", "A alone, B driven"),
    "A = -B": (style.BLUE, "s", "A = \N{MINUS SIGN}B"),
    "A = B": ("#16876b", "^", "A = B"),
}
DRIVES = ("#a9bbe0", "#e0a100", "#16876b", style.BLUE, style.RED)


# --- Families -------------------------------------------------------------------------------------


PAIRS, PAIR = 1, 2
"""What collides: two pairs of multipliers, which make a quartet, or a pair with itself."""
CROWDED = 1.5
"""Collisions nearer to the waves than this times the second frequency are drawn in an inset."""
ABOVE = 9
"""How far above its place a collision is marked, in points: breathers have marks of their own."""
COLLISION_LOOKS = {PAIRS: ("*", 6, "two pairs collide"), PAIR: ("X", 4.5, "a pair meets itself")}


def gather_breathers(periodic: xr.Dataset, growth: xr.Dataset) -> xr.Dataset:
    """Return P, growth and collisions of breathers, and what the drive feeds, as they are drawn."""
    met = np.isfinite(periodic["collision_frequency"])
    of_two = periodic["collision_multiplier"].sel(part="im", drop=True) > 0.0
    drawn = xr.Dataset(
        {
            "total_power": periodic["power"].sum("component", skipna=False),
            "unstable": (periodic["growth"] > 0).astype(np.int8),
            "collision": (met * np.where(of_two, PAIRS, PAIR)).astype(np.int8),
            **{name: periodic[name] for name in
               ("highest_wave", "collision_frequency", "collision_power")},
            **{name: growth[name] for name in ("time", "gained", "predicted_gain")},
        }
    )  # fmt: skip
    described = {
        "total_power": "P of the breather at the instants when all A_n and B_n are real",
        "unstable": "1 if a perturbation grows",
        "collision": f"{PAIRS} where two pairs of multipliers collide, {PAIR} a pair with itself",
    }
    for name, words in described.items():
        drawn[name].attrs = {"long_name": words, "units": "1"}
    return drawn


@style.styled
def draw_breathers(data: xr.Dataset) -> Figure:
    """Draw P against the frequency for each family and Omega; beside it, growth by the drive."""
    figure = style.new_figure(style.DOUBLE, 3.0)
    panels = figure.subplots(1, data.sizes["omega"] + 1)
    for letter, axes, omega in zip("abcdef", panels, data["omega"].values, strict=False):
        _draw_families(axes, data.sel(omega=omega))
        axes.set_title(rf"({letter}) $\Omega = {omega:g}$", loc="left")
    _draw_growth(panels[-1], data)
    panels[-1].set_title(f"({'abcdef'[len(panels) - 1]}) growth by the drive", loc="left")
    shown = [
        Line2D([], [], color=colour, marker=marker, markersize=4, label=words)
        for colour, marker, words in FAMILY_LOOKS.values()
    ]
    shown.append(
        Line2D([], [], color="0.3", marker="o", markerfacecolor="white", ls="none", markersize=4,
               label="unstable")
    )  # fmt: skip
    shown += [
        Line2D([], [], color="black", marker=marker, ls="none", markersize=size, label=words)
        for kind, (marker, size, words) in COLLISION_LOOKS.items()
        if (data["collision"] == kind).any()
    ]
    figure.legend(handles=shown, loc="outside upper center", ncols=3)
    return figure


def _draw_families(axes: Axes, data: xr.Dataset) -> None:
    """Draw P of each family; equal steps to the right multiply the distance from the waves."""
    edge = float(data["highest_wave"])
    data = data.sel(frequency=data["frequency"] > edge)
    frequency = data["frequency"].values
    met = data["collision_frequency"].values - edge
    crowded = met < CROWDED * (frequency[1] - edge)
    _draw_members(axes, data, ~crowded)
    axes.set_xscale("log")
    ticks = [frequency[0]]
    for tick in frequency[1:]:
        if tick - edge > 1.6 * (ticks[-1] - edge):
            ticks.append(tick)
    axes.set_xticks(np.array(ticks) - edge, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_ylim(0, None)
    axes.set_xlabel(rf"frequency $\lambda$, on the scale $\log (\lambda - {edge:g})$")
    axes.set_ylabel("$P$ when all $A_n$ and $B_n$ are real")
    if crowded.any():
        inset = axes.inset_axes((0.16, 0.52, 0.46, 0.44))
        _draw_members(inset, data, crowded)
        found = data["collision_power"].values[crowded]
        inset.set(xlim=(0.92 * (frequency[0] - edge), 1.1 * met[crowded].max()),
                  ylim=(0.9 * found.min(), 1.15 * found.max()))  # fmt: skip
        inset.set_xticks(frequency[:2] - edge, [f"{tick:g}" for tick in frequency[:2]])
        inset.tick_params(labelsize=7)
        axes.indicate_inset_zoom(inset, edgecolor="0.4")


def _draw_members(axes: Axes, data: xr.Dataset, shown: np.ndarray) -> None:
    """Draw the breathers of each family, and those of their collisions that are to be shown."""
    edge, frequency = float(data["highest_wave"]), data["frequency"].values
    for family, (colour, marker, _) in FAMILY_LOOKS.items():
        power = data["total_power"].sel(family=family).values
        grows = data["unstable"].sel(family=family).values == 1
        axes.plot(frequency - edge, power, color=colour, lw=0.8)
        for some, face in ((grows, "white"), (~grows, colour)):
            axes.plot(
                frequency[some] - edge, power[some], color=colour, marker=marker, markersize=3.5,
                linestyle="none", markerfacecolor=face,
            )  # fmt: skip
    above = offset_copy(axes.transData, axes.figure, 0.0, ABOVE, "points")
    for kind, (marker, size, _) in COLLISION_LOOKS.items():
        some = shown & (data["collision"].values == kind)
        at = data["collision_frequency"].values[some] - edge, data["collision_power"].values[some]
        axes.plot(*at, transform=above, color="black", marker=marker, markersize=size, ls="none",
                  zorder=4)  # fmt: skip
        for place in zip(*at, strict=True):
            axes.annotate(
                "",
                place,
                (0, ABOVE),
                textcoords="offset points",
                arrowprops={"arrowstyle": "-", "lw": 0.6, "shrinkA": 0, "shrinkB": 0},
            )


def _draw_growth(axes: Axes, data: xr.Dataset) -> None:
    for colour, gamma in zip(DRIVES, data["gamma"].values, strict=False):
        run = data.sel(gamma=gamma).isel(output=slice(1, None))
        look = {"color": colour, "lw": 0.9}
        axes.plot(run["time"], run["gained"], label=rf"$\gamma = {gamma:g}$", **look)
        axes.plot(run["time"], run["predicted_gain"], ls="--", **look)
    most = float(data["predicted_gain"].max())
    axes.plot([], [], color="0.3", lw=0.9, ls="--", label="law")
    axes.set_xscale("log")
    axes.set_ylim(0, 3.2 * most)
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel(r"$\|B\|^2$, gained by $A$ too")
    axes.legend(fontsize=7, loc="upper left", handlelength=1.4)


# --- Sensitivity ----------------------------------------------------------------------------------

SENSITIVITY = ("share", "share_low", "share_high", "largest_l2", "spread")


def gather_sensitivity(sensitivity: xr.Dataset) -> xr.Dataset:
    """Return the shares that spread, and the scan of amplitudes, as they are drawn."""
    return sensitivity[list(SENSITIVITY)]


@style.styled
def draw_sensitivity(data: xr.Dataset) -> Figure:
    """Draw the share that spreads against the size of a change, and the largest norm by A_0."""
    figure = style.new_figure(style.DOUBLE, 2.5)
    shares, scan = figure.subplots(1, 2, width_ratios=(1, 1.4))
    value = data["share"].values
    bars = [value - data["share_low"].values, data["share_high"].values - value]
    shares.errorbar(data["size"].values, value, bars, color=style.BLUE, marker="o", markersize=3.5,
                    elinewidth=0.8, capsize=2)  # fmt: skip
    shares.set_xscale("log")
    shares.set_ylim(-0.03, 1.05)
    shares.set_xlabel("relative change of the data")
    shares.set_ylabel("share of runs that spread")
    shares.set_title("(a) random changes", loc="left")
    for spread, colour, label in ((0, style.BLUE, "does not spread"), (1, style.RED, "spreads")):
        some = data["spread"].values == spread
        scan.plot(
            data["initial"].values[some], data["largest_l2"].values[some], color=colour,
            marker="o^"[spread], markersize=3, linestyle="none", label=label,
        )  # fmt: skip
    scan.set_xlabel("initial amplitude $A_0$")
    scan.set_ylabel(r"largest $l^2$ norm of $A$ and $B$")
    scan.set_ylim(0, None)
    scan.set_title("(b) a scan of amplitudes", loc="left")
    scan.legend(loc="upper right")
    return figure
