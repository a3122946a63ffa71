"""The figures of the study: families of breathers, sensitivity to data, and the maps of fates."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import offset_copy

from pendula.drawing import style

FAMILY_LOOKS = {
    "A only": (style.RED, "o", "A alone, B driven"),
    "A = -B": (style.BLUE, "s", "A = \N{MINUS SIGN}B"),
    "A = B": ("#16876b", "^", "A = B"),
}
DRIVES = ("#a9bbe0", "#e0a100", "#16876b", style.BLUE, style.RED)
PAIRS, PAIR = 1, 2
"""What collides: two pairs of multipliers, which make a quartet, or a pair with itself."""
CROWDED = 1.5
"""Collisions nearer to the waves than this times the second frequency are drawn in an inset."""
ABOVE = 9
"""How far above its place a collision is marked, in points: breathers have marks of their own."""
COLLISION_LOOKS = {PAIRS: ("*", 6, "two pairs collide"), PAIR: ("X", 4.5, "a pair meets itself")}


# --- Families -------------------------------------------------------------------------------------


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
    *panels, last = figure.subplots(1, data.sizes["omega"] + 1)
    for letter, axes, omega in zip("abcdef", panels, data["omega"].values, strict=False):
        _draw_families(axes, data.sel(omega=omega))
        axes.set_title(rf"({letter}) $\Omega = {omega:g}$", loc="left")
    _draw_growth(last, data)
    last.set_title(f"({'abcdef'[len(panels)]}) growth by the drive", loc="left")
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
            line = {"arrowstyle": "-", "lw": 0.6, "shrinkA": 0, "shrinkB": 0}
            axes.annotate("", place, (0, ABOVE), textcoords="offset points", arrowprops=line)


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


def gather_sensitivity(sensitivity: xr.Dataset) -> xr.Dataset:
    """Return the shares that spread, and the scan of amplitudes, as they are drawn."""
    return sensitivity[["share", "share_low", "share_high", "largest_l2", "spread"]]


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
    shares.set_xlabel("relative perturbation of $A_0$ and $B_0$")
    shares.set_ylabel("share of runs that spread")
    shares.set_title("(a) random perturbations", loc="left")
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


# --- Maps of fates --------------------------------------------------------------------------------

LOOKS = {
    "disperses": "#e4e4e0",
    "stays, not periodic": "#8fb8e8",
    "stays, periodic: a breather": style.BLUE,
    "stays, not known whether periodic": "#c9a2c9",
    "moves away": "#16876b",
    "spreads": "#e8622c",
}
"""The fates in their order; what stays is divided by whether it is periodic. The colours are of
lightness so different that they stay apart in grey and for people who see two colours."""
KINDS = tuple(LOOKS)
COLOURS = ListedColormap([*LOOKS.values()], name="kinds of ends")

MAPS = ("fate", "periodic", "turned_fate", "turned_periodic")
PAPERS = "the paper's initial conditions"
OF_CASES = ("case_omega", "case_a0", "case_b0", "case_fate", "case_periodic")
FATES_CAPTION = (
    "What becomes of an excited central pair by τ = {end}: above by its amplitudes A₀ and B₀, "
    "below by A₀ and the phase of B₀, at each Ω. A motion stays if the three central pairs hold "
    "most of P, and moves away if three others do; else it disperses if P is no larger than "
    "linear waves make it, and spreads if P is larger. Circles mark the initial conditions of "
    "Figs 2 to 4, in the colour of their own fate."
)


def gather_fates(
    fates: xr.Dataset, fine: xr.Dataset | None = None, of_paper: bool = True
) -> xr.Dataset:
    """Return both maps and what becomes of the data of the cases, as they are drawn.

    The maps are those of `fine` if these are of the same runs: if they have data in common with
    `fates` at each Omega. `of_paper` says whether the cases are the paper's.
    """
    shown = fates
    if fine is not None and bool((fates["common"] > 0).all()):
        shown = fine.sel(omega=fates["omega"])
    maps = shown[[*MAPS]].assign(fates[[*OF_CASES]])
    about = {} if of_paper else {"marked": "initial conditions of Figs 2 to 4"}
    caption = FATES_CAPTION.format(end=f"{float(fates.attrs['end_time']):g}")
    return maps.assign_attrs(about, ratio=fates.attrs["ratio"], caption=caption)


def kind_of(fate: np.ndarray, periodic: np.ndarray) -> np.ndarray:
    """Return the number in KINDS of each end of a run; `periodic` is -1, 0 or 1."""
    return np.choose(fate, [0, 1 + periodic % 3, 4, 5])


@style.styled
def draw_fates(data: xr.Dataset) -> Figure:
    """Draw the fate of each (A_0, B_0), below it that of each phase of B_0; a column an Omega."""
    figure = style.new_figure(style.DOUBLE, 5.2)
    grid = figure.subplots(2, data.sizes["omega"], sharey="row", squeeze=False)
    letters = np.array(list("abcdefghijklmnop")[: grid.size]).reshape(grid.shape)
    for column, omega in enumerate(data["omega"].values):
        here = data.sel(omega=omega)
        above, below = grid[:, column]
        _draw_map(above, here, ("a0", "b0"), "")
        # phases begin with the column of phase pi, turned back to -pi
        turned = here[["turned_fate", "turned_periodic"]]
        last = turned.isel(phase=[-1])
        first = last.assign_coords(phase=last["phase"] - 2 * np.pi)
        _draw_map(below, xr.concat([first, turned], "phase"), ("phase", "turned_a0"), "turned_")
        _mark_cases(above, below, data, omega)
        above.set_title(rf"({letters[0, column]}) $\Omega = {omega:g}$", loc="left")
        below.set_title(rf"({letters[1, column]}) $\Omega = {omega:g}$", loc="left")
        above.set_xlabel("$A_0$")
        below.set(xlabel="phase of $B_0$", xlim=(-np.pi, np.pi))
        below.set_xticks(np.pi * np.arange(-1, 2), [r"$-\pi$", "$0$", r"$\pi$"])
    grid[0, 0].set_ylabel("$B_0$")
    grid[1, 0].set_ylabel(rf"$A_0$, with $|B_0| = {data.attrs['ratio']:g}\,A_0$")
    kinds = [kind_of(data[fate].values, data[periodic].values).ravel()
             for fate, periodic in (MAPS[:2], MAPS[2:])]  # fmt: skip
    shown = [
        Patch(color=COLOURS(kind), label=KINDS[kind]) for kind in np.unique(np.concatenate(kinds))
    ]
    paper = Line2D([], [], marker="o", ls="none", markersize=5, markerfacecolor="white",
                   color="black", label=data.attrs.get("marked", PAPERS))  # fmt: skip
    figure.legend(handles=[*shown, paper], loc="outside upper center", ncols=3)
    return figure


def _draw_map(axes: Axes, here: xr.Dataset, over: tuple[str, str], start: str) -> None:
    """Draw one map by the kind of each end, a cell around each of the equally spaced data."""
    ends = (here[f"{start}{name}"].transpose(*over[::-1]).values for name in ("fate", "periodic"))
    extent = []
    for name in over:
        centres = here[name].values
        half = 0.5 * (centres[1] - centres[0])
        extent += [float(centres[0] - half), float(centres[-1] + half)]
    axes.imshow(
        kind_of(*ends), cmap=COLOURS, vmin=-0.5, vmax=COLOURS.N - 0.5, extent=extent,
        origin="lower", aspect="auto", interpolation="none",
    )  # fmt: skip


def _mark_cases(above: Axes, below: Axes, data: xr.Dataset, omega: float) -> None:
    """Mark the data of the cases by circles in the colour of their own fate, where a map has them.

    The map over phases has those whose B_0 is as large as on that map.
    """
    for case in data["case"].values[data["case_omega"].values == omega]:
        one = data.sel(case=case)
        a, b = float(one["case_a0"]), float(one["case_b0"])
        colour = COLOURS(kind_of(one["case_fate"].values, one["case_periodic"].values))
        places = [(above, (a, b))]
        if abs(b - data.attrs["ratio"] * a) < 1e-9 * a:
            places.append((below, (0.0, a)))
        for axes, at in places:
            axes.plot(*at, marker="o", markersize=7.5, color="white")
            axes.plot(*at, marker="o", markersize=5, color="black", markerfacecolor=colour)
