"""Maps of what becomes of initial conditions on one pair."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

LOOKS = {
    "disperses": "#fdfcf8",
    "stays localised": "#0b1d51",
    "moves away": "#007a5a",
    "spreads": "#f2a33c",
}
"""The fates in their order, in hues that people with any colour vision distinguish, and at least
25 % of the way from black to white apart in grey."""
KINDS = tuple(LOOKS)
COLOURS = ListedColormap([*LOOKS.values()], name="fates")

MAPS = ("fate", "turned_fate")
SAME_RUNS = ("boundary", "end_time", "epsilon", "gamma", "half_width", "ratio", "solver_rtol")
"""What two maps must have in common to be of the same runs, beside their detunings."""
PAPERS = "initial conditions of the paper"
OF_CASES = ("case_omega", "case_a0", "case_b0", "case_fate")
FATES_CAPTION = (
    "Fate of an excited central pair at τ = {end}, for each Ω: above by its amplitudes A₀ and B₀, "
    "below by A₀ and the phase of B₀. A motion stays localised if the central pair and its "
    "neighbours hold more than half of P at the end, and moves away if three other neighbouring "
    "pairs do. Otherwise it disperses if P is no larger than linear waves can make it, and spreads "
    "if P is larger. Circles mark the initial conditions of Figs 2 to 4, filled with the colour of "
    "their fate."
)


def gather_fates(
    fates: xr.Dataset, fine: xr.Dataset | None = None, of_paper: bool = True
) -> xr.Dataset:
    """Return both maps and what becomes of the data of the cases, as they are drawn.

    The maps are those of `fine` if these are of the same runs. `of_paper` says whether the cases
    are the paper's.
    """
    shown, omegas = fates, fates["omega"].values
    known = fine is not None and np.isin(omegas, fine["omega"].values).all()
    if known and all(fates.attrs[name] == fine.attrs[name] for name in SAME_RUNS):
        shown = fine.sel(omega=omegas)
    maps = shown[[*MAPS]].assign(fates[[*OF_CASES]])
    about = {} if of_paper else {"marked": "initial conditions of Figs 2 to 4"}
    caption = FATES_CAPTION.format(end=f"{float(fates.attrs['end_time']):g}")
    return maps.assign_attrs(about, ratio=fates.attrs["ratio"], caption=caption)


@style.styled
def draw_fates(data: xr.Dataset) -> Figure:
    """Draw the fate of each (A_0, B_0), below it that of each phase of B_0; a column an Omega."""
    figure = style.new_figure(style.WIDTH, 3.7)
    grid = figure.subplots(2, data.sizes["omega"], sharey="row", squeeze=False)
    letters = np.array(list("abcdefghijklmnop")[: grid.size]).reshape(grid.shape)
    for column, omega in enumerate(data["omega"].values):
        here = data.sel(omega=omega)
        above, below = grid[:, column]
        _draw_map(above, here["fate"], ("a0", "b0"))
        # phases begin with the column of phase pi, turned back to -pi
        turned = here["turned_fate"]
        last = turned.isel(phase=[-1])
        first = last.assign_coords(phase=last["phase"] - 2 * np.pi)
        _draw_map(below, xr.concat([first, turned], "phase"), ("phase", "turned_a0"))
        _mark_cases(above, below, data, omega)
        above.set_title(rf"({letters[0, column]}) $\Omega = {omega:g}$", loc="left")
        below.set_title(rf"({letters[1, column]}) $\Omega = {omega:g}$", loc="left")
        above.set_xlabel("$A_0$")
        below.set(xlabel="phase of $B_0$", xlim=(-np.pi, np.pi))
        below.set_xticks(np.pi * np.arange(-1, 2), [r"$-\pi$", "$0$", r"$\pi$"])
    grid[0, 0].set_ylabel("$B_0$")
    grid[1, 0].set_ylabel(rf"$A_0$, with $|B_0| = {data.attrs['ratio']:g}\,A_0$")
    kinds = np.unique(np.concatenate([data[name].values.ravel() for name in MAPS]))
    shown = [Patch(facecolor=COLOURS(kind), edgecolor="0.5", label=KINDS[kind]) for kind in kinds]
    paper = Line2D([], [], marker="o", ls="none", markersize=5, markerfacecolor="white",
                   color="black", label=data.attrs.get("marked", PAPERS))  # fmt: skip
    figure.legend(handles=[*shown, paper], loc="outside upper center", ncols=5,
                  columnspacing=1.2)  # fmt: skip
    return figure


def _draw_map(axes: Axes, fates: xr.DataArray, over: tuple[str, str]) -> None:
    """Draw one map of fates, a cell around each of the equally spaced data."""
    extent = []
    for name in over:
        centres = fates[name].values
        half = 0.5 * (centres[1] - centres[0])
        extent += [float(centres[0] - half), float(centres[-1] + half)]
    axes.imshow(
        fates.transpose(*over[::-1]).values, cmap=COLOURS, vmin=-0.5, vmax=COLOURS.N - 0.5,
        extent=extent, origin="lower", aspect="auto", interpolation="none",
    )  # fmt: skip


def _mark_cases(above: Axes, below: Axes, data: xr.Dataset, omega: float) -> None:
    """Mark the data of the cases by circles in the colour of their own fate, where a map has them.

    The map over phases has those whose B_0 is as large as on that map.
    """
    for case in data["case"].values[data["case_omega"].values == omega]:
        one = data.sel(case=case)
        a, b = float(one["case_a0"]), float(one["case_b0"])
        colour = COLOURS(int(one["case_fate"]))
        places = [(above, (a, b))]
        if abs(b - data.attrs["ratio"] * a) < 1e-9 * a:
            places.append((below, (0.0, a)))
        for axes, at in places:
            axes.plot(*at, marker="o", markersize=7.5, color="white", clip_on=False)
            axes.plot(
                *at, marker="o", markersize=5, color="black", markerfacecolor=colour, clip_on=False
            )
