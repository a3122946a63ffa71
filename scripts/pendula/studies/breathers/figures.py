"""The figure that maps the fate of initial conditions on one pair."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from replication.variables import chaotic_along

LOOKS = {
    "disperses": "#fdfcf8",
    "stays localised": "#0b1d51",
    "moves away": "#007a5a",
    "spreads": "#f2a33c",
}
"""Colours of the fates, in order. Their hues differ for any colour vision, and their greys by at
least 25 % of the range from black to white."""
KINDS = tuple(LOOKS)
COLOURS = ListedColormap([*LOOKS.values()], name="fates")

MARK = {"marker": "o", "markersize": 5, "color": "black", "markerfacecolor": "white"}
"""White with a black rim, visible on every fate with any colour vision."""
SAME_RUNS = ("boundary", "end_time", "epsilon", "gamma", "half_width", "solver_rtol")
"""Attributes that are equal in two maps of the same runs."""
OF_PAPER = ((1.0, 0.1), (5.0, 1.0))
"""A_0 and B_0 of Figs 2 to 4."""
FATES_CAPTION = (
    "Fate of an excited central pair at τ = {end}, for each Ω, by its amplitudes A₀ and B₀. A "
    "motion stays localised if the central pair and its neighbours hold more than half of P at the "
    "end, and moves away if three other neighbouring pairs do. Otherwise it disperses if P is no "
    "larger than linear waves can make it, and spreads if P is larger. Circles mark the initial "
    "conditions of Figs 2 to 4."
)


def gather_fates(fates: xr.Dataset, fine: xr.Dataset | None = None) -> xr.Dataset:
    """Return the map to draw: `fine` if it has the same runs on a finer grid, else `fates`."""
    fate_map, omegas = fates, fates["omega"].values
    known = fine is not None and np.isin(omegas, fine["omega"].values).all()
    if known and all(fates.attrs[name] == fine.attrs[name] for name in SAME_RUNS):
        fate_map = fine.sel(omega=omegas)
    caption = FATES_CAPTION.format(end=f"{float(fates.attrs['end_time']):g}")
    return fate_map[["fate"]].assign_attrs(caption=caption, **chaotic_along("omega"))


@style.styled
def draw_fates(data: xr.Dataset) -> Figure:
    """Draw the fate of each (A_0, B_0), one panel for each Omega."""
    figure = style.new_figure(style.WIDTH, 2.2)
    row = figure.subplots(1, data.sizes["omega"], sharey=True, squeeze=False)[0]
    for axes, omega, letter in zip(row, data["omega"].values, "abcdefghijklmnop", strict=False):
        _draw_map(axes, data["fate"].sel(omega=omega))
        axes.set_title(rf"({letter}) $\Omega = {omega:g}$", loc="left")
    row[0].set_ylabel("$B_0$")
    patches = [
        Patch(facecolor=COLOURS(kind), edgecolor="0.5", label=KINDS[kind])
        for kind in np.unique(data["fate"])
    ]
    paper = Line2D([], [], ls="none", label="initial conditions of Figs 2 to 4", **MARK)
    figure.legend(handles=[*patches, paper], loc="outside upper center", ncols=5, columnspacing=1.2)
    return figure


def _draw_map(axes: Axes, fates: xr.DataArray) -> None:
    """Draw a cell around each grid point, and marks at the paper's initial conditions."""
    ends = []
    for name in ("a0", "b0"):
        centres = fates[name].values
        half = 0.5 * (centres[1] - centres[0])
        ends += [float(centres[0] - half), float(centres[-1] + half)]
    axes.imshow(
        fates.transpose("b0", "a0").values,
        cmap=COLOURS,
        vmin=-0.5,
        vmax=COLOURS.N - 0.5,
        extent=ends,
        origin="lower",
        aspect="auto",
        interpolation="none",
    )
    for point in OF_PAPER:
        axes.plot(*point, clip_on=False, **MARK)
    axes.set(xlabel="$A_0$", xlim=ends[:2], ylim=ends[2:])
