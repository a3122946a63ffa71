"""The maps of fates in a picture: over two amplitudes, and over an amplitude and a phase."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, ListedColormap, Normalize, to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from pendula.drawing import style

FAR = "#bcd0ee"
FATE_LOOKS = {
    "disperses": ("#e4e4e0", "disperses"),
    "breather": (style.BLUE, "stays as a breather"),
    "moves": ("#16876b", "moves away"),
    "spreads": ("#e8622c", "spreads"),
}
"""Grey, blue, green and orange, of lightness so different that they stay apart in grey and for
people who see two colours."""
FATES = tuple(FATE_LOOKS)
BREATHER = FATES.index("breather")
NEARNESS = LinearSegmentedColormap.from_list("nearness", [style.BLUE, "#4f7cc4", FAR])
FARTHEST = 1.0
"""The distance that is drawn as the largest: the other amplitude is then as large as the leading
one, or a family is too far to name."""
SHADES = NEARNESS.N
COLOURS = ListedColormap(
    [*NEARNESS(np.arange(SHADES)), *(to_rgba(colour) for colour, _ in FATE_LOOKS.values())],
    name="shades of breathers, then fates",
)
"""All colours of a map, so that it is one image: first the shades of breathers, the nearest one
first, then the fates in their order."""

MAPS = ("fate", "family_distance", "turned_fate", "turned_family_distance")
OF_CASES = ("case_omega", "case_a0", "case_b0", "case_fate")


def gather_fates(fates: xr.Dataset) -> xr.Dataset:
    """Return both maps and what becomes of the paper's data, as they are drawn."""
    return fates[[*MAPS, *OF_CASES]].assign_attrs(ratio=fates.attrs["ratio"])


@style.styled
def draw_fates(data: xr.Dataset) -> Figure:
    """Draw the fate of each (A_0, B_0), below it that of each phase of B_0; a column an Omega."""
    figure = style.new_figure(style.DOUBLE, 5.2)
    grid = figure.subplots(2, data.sizes["omega"], sharey="row", squeeze=False)
    letters = np.array(list("abcdefghijklmnop")[: grid.size]).reshape(grid.shape)
    for column, omega in enumerate(data["omega"].values):
        here = data.sel(omega=omega)
        above, below = grid[:, column]
        _draw(above, here, ("a0", "b0"), "")
        turned = _all_round(here[["turned_fate", "turned_family_distance"]])
        _draw(below, turned, ("phase", "turned_a0"), "turned_")
        _mark(above, data, omega, lambda a, b: (a, b))
        _mark(below, data, omega, _at_no_phase(data.attrs["ratio"]))
        above.set_title(rf"({letters[0, column]}) $\Omega = {omega:g}$", loc="left")
        below.set_title(rf"({letters[1, column]}) $\Omega = {omega:g}$", loc="left")
        above.set_xlabel("$A_0$")
        below.set(xlabel="phase of $B_0$", xlim=(-np.pi, np.pi))
        below.set_xticks(np.pi * np.arange(-1, 2), [r"$-\pi$", "$0$", r"$\pi$"])
    grid[0, 0].set_ylabel("$B_0$")
    grid[1, 0].set_ylabel(rf"$A_0$, with $|B_0| = {data.attrs['ratio']:g}\,A_0$")
    _explain(figure, grid, data)
    return figure


def _draw(axes: Axes, here: xr.Dataset, over: tuple[str, str], start: str) -> None:
    """Draw one map: its fates, and by its shade how near to a periodic one each breather is."""
    across, up = over
    fate = here[f"{start}fate"].transpose(up, across).values
    far = here[f"{start}family_distance"].transpose(up, across).fillna(FARTHEST).values
    shade = np.rint(np.minimum(far / FARTHEST, 1.0) * (SHADES - 1))
    axes.imshow(
        np.where(fate == BREATHER, shade, fate + float(SHADES)), cmap=COLOURS, vmin=-0.5,
        vmax=COLOURS.N - 0.5, extent=(*_ends(here[across].values), *_ends(here[up].values)),
        origin="lower", aspect="auto", interpolation="none",
    )  # fmt: skip


def _ends(centres: np.ndarray) -> tuple[float, float]:
    """Return between what equal cells lie that have these centres."""
    half = 0.5 * (centres[1] - centres[0])
    return float(centres[0] - half), float(centres[-1] + half)


def _all_round(data: xr.Dataset) -> xr.Dataset:
    """Return a map over phases that begins with the column of phase pi, turned back to -pi."""
    last = data.isel(phase=[-1])
    return xr.concat([last.assign_coords(phase=last["phase"] - 2 * np.pi), data], "phase")


def _at_no_phase(ratio: float):
    """Return where data stand on the map over phases, if they stand there."""
    return lambda a, b: (0.0, a) if abs(b - ratio * a) < 1e-9 * a else None


def _mark(axes: Axes, data: xr.Dataset, omega: float, place) -> None:
    """Mark the paper's data by circles in the colour of their own fate."""
    for case in data["case"].values[data["case_omega"].values == omega]:
        one = data.sel(case=case)
        at = place(float(one["case_a0"]), float(one["case_b0"]))
        if at:
            colour, _ = FATE_LOOKS[FATES[int(one["case_fate"])]]
            axes.plot(*at, marker="o", markersize=7.5, color="white")
            axes.plot(*at, marker="o", markersize=5, color="black", markerfacecolor=colour)


def _explain(figure: Figure, grid: np.ndarray, data: xr.Dataset) -> None:
    """Name the fates that occur, and give the scale of the breathers' blue."""
    occur = np.unique(
        np.concatenate([data[name].values.ravel() for name in ("fate", "turned_fate")])
    )
    shown = [
        Patch(color=colour, label=words)
        for number, (colour, words) in enumerate(FATE_LOOKS.values())
        if number in occur
    ]
    paper = Line2D([], [], marker="o", ls="none", markersize=5, markerfacecolor="white",
                   color="black", label="the paper's data")  # fmt: skip
    figure.legend(handles=[*shown, paper], loc="outside upper center", ncols=5)
    if BREATHER in occur:
        scale = ScalarMappable(Normalize(0.0, FARTHEST), NEARNESS)
        bar = figure.colorbar(scale, ax=grid.ravel().tolist(), pad=0.015, aspect=30, extend="max")
        bar.set_label("breathers: distance from the nearest periodic one")
