"""The maps of fates in a picture: over two amplitudes, and over an amplitude and a phase."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from pendula.drawing import style

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
OF_CASES = ("case_omega", "case_a0", "case_b0", "case_fate", "case_periodic")


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
    about = {} if of_paper else {"marked": "the data of Figs 2 to 4"}
    return maps.assign_attrs(about, ratio=fates.attrs["ratio"])


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
        _draw(above, here, ("a0", "b0"), "")
        turned = _all_round(here[["turned_fate", "turned_periodic"]])
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
    _explain(figure, data)
    return figure


def _draw(axes: Axes, here: xr.Dataset, over: tuple[str, str], start: str) -> None:
    """Draw one map by the kind of each end."""
    across, up = over
    ends = (here[f"{start}{name}"].transpose(up, across).values for name in ("fate", "periodic"))
    axes.imshow(
        kind_of(*ends), cmap=COLOURS, vmin=-0.5, vmax=COLOURS.N - 0.5,
        extent=(*_ends(here[across].values), *_ends(here[up].values)),
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
            colour = COLOURS(kind_of(one["case_fate"].values, one["case_periodic"].values))
            axes.plot(*at, marker="o", markersize=7.5, color="white")
            axes.plot(*at, marker="o", markersize=5, color="black", markerfacecolor=colour)


def _explain(figure: Figure, data: xr.Dataset) -> None:
    """Name the kinds of ends that occur on the maps."""
    occur = {
        int(kind)
        for start in ("", "turned_")
        for kind in np.unique(kind_of(data[f"{start}fate"].values, data[f"{start}periodic"].values))
    }
    shown = [Patch(color=COLOURS(kind), label=KINDS[kind]) for kind in sorted(occur)]
    paper = Line2D([], [], marker="o", ls="none", markersize=5, markerfacecolor="white",
                   color="black", label=data.attrs.get("marked", "the paper's data"))  # fmt: skip
    figure.legend(handles=[*shown, paper], loc="outside upper center", ncols=3)
