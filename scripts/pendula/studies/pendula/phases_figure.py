"""The paper's phases in the real pendula, in a picture: norms and space-time, case by mu."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator, StrMethodFormatter

from pendula.datasets.registry import NAMES
from pendula.drawing import style

LOOKS = ("0.7", "#5aa7d6", "#16876b", "#e0a100", style.RED, "#000000")
"""Colours by mu: a wide grey line for the amplitudes, and one hue for each mu."""
NORMS = {"l2": r"$\ell^2$", "linf": r"$\ell^\infty$"}
"""A panel for each, so that a line shows mu by its colour alone."""
LARGEST, OVER = 0.999, 2.0
"""The largest modulus below the top that is told from others, and what stands for one beyond it."""
MODULI = colormaps["inferno"].with_extremes(bad="white", over="#35c7b1")
LETTERS = "abcdefghijkl"
ABOVE, ROW, BELOW = 0.44, 1.0, 0.9
"""Heights in inches: of the legend and the names of mu, of a row, and of what stands below all."""
LOG_FROM = 6.0
"""A norm that varies by more than this factor is drawn on a logarithmic scale."""
APART = 3
"""Columns between the pictures of neighbouring mu; each snapshot takes one column."""


def gather_phases(phases: xr.Dataset) -> xr.Dataset:
    """Return norms of the pair, and the larger modulus on each site over time."""
    l2 = np.sqrt((phases["l2"] ** 2).sum("component", skipna=False))
    linf = phases["linf"].max("component")
    norms = {
        name: one.assign_attrs(long_name=f"{NAMES[name]}, of A and B together", units="1")
        for name, one in {"l2": l2, "linf": linf}.items()
    }
    kept = phases[["larger_modulus", "snapshot_tau", "omega", "initial"]]
    return kept.assign(norms)


@style.styled
def draw_phases(data: xr.Dataset) -> Figure:
    """Draw a row for each case: both norms by mu, and a space-time picture for each mu."""
    cases = data["case"].values
    figure = style.new_figure(style.DOUBLE, ABOVE + ROW * len(cases) + BELOW)
    grid, bar = _panels(figure, len(cases))
    for letter, panels, name in zip(LETTERS, grid, cases, strict=False):
        case = data.sel(case=name)
        for axes, norm in zip(panels, NORMS, strict=False):
            _draw_norm(axes, case, norm)
        panels[0].set_title(f"({letter}) {style.name_case(case)}", loc="left", fontsize=7)
        image = _draw_strip(panels[-1], case)
    for axes in grid[:-1].flat:
        axes.set_xticks([])  # each tick takes time, and those below serve all rows
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    _number_times(grid[-1, -1], data)
    _name_strips(grid[0, -1], data)
    bar = figure.colorbar(image, cax=bar, orientation="horizontal")
    bar.set_label(r"modulus over the largest by (4); green: $2 \mu |A| > \pi$, over the top")
    _name_curves(figure, data["mu"].values)
    return figure


def _panels(figure: Figure, rows: int) -> tuple[np.ndarray, Axes]:
    """Return three panels a row, and below those of the pictures the place of their colour bar.

    All stand at given places: to find these would take a quarter of the time of the drawing.
    """
    figure.set_layout_engine("none")
    height = figure.get_figheight()
    sides = {"left": 0.075, "right": 0.994, "wspace": 0.3}
    grid = figure.subplots(rows, 3, squeeze=False, gridspec_kw={
        "top": 1.0 - ABOVE / height, "bottom": BELOW / height, "hspace": 0.32,
        "width_ratios": (1.6, 1.6, 5.0), **sides})  # fmt: skip
    return grid, figure.add_axes((0.45, 0.42 / height, 0.47, 0.1 / height))


def _name(mu: float) -> str:
    return rf"$\mu = {mu:g}$" if mu else "eqs (4)"


def _draw_norm(axes: Axes, case: xr.Dataset, norm: str) -> None:
    for colour, mu in zip(LOOKS, case["mu"].values, strict=False):
        # pendula over the top swing the most: they lie behind the others, and (4) behind all
        axes.plot(case["tau"], case[norm].sel(mu=mu), zorder=3.0 - mu if mu else 2.0,
                  color=colour, lw=0.7 if mu else 2.2)  # fmt: skip
    spans = float(case[norm].max()) / float(case[norm].min())
    if spans > LOG_FROM:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if spans < 30.0 else (1.0,)))
    else:
        axes.yaxis.set_major_locator(MaxNLocator(3))
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylabel(NORMS[norm])
    axes.yaxis.set_label_coords(-0.27, 0.5)


def _draw_strip(axes: Axes, case: xr.Dataset):
    """Draw the moduli of all mu beside each other in one picture, which is drawn far sooner."""
    case = case.dropna("site", how="all")  # what a chain shorter than another does not have
    moduli = case["larger_modulus"].transpose("mu", "site", "snapshot").values
    peak = float(moduli[case["mu"].values == 0.0].max()) or 1.0
    turned = 2.0 * case["mu"].values[:, None, None] * moduli > np.pi
    shown = np.where(turned, OVER, np.minimum(moduli / peak, LARGEST))
    apart = np.full((len(shown), case.sizes["site"], APART), np.nan)
    columns = np.concatenate([shown, apart], axis=2).transpose(1, 0, 2).reshape(len(apart[0]), -1)
    sites = case["site"].values[0] - 0.5, case["site"].values[-1] + 0.5
    last = _starts(case)[-1] + _width(case)
    image = axes.imshow(
        columns[:, :-APART], cmap=MODULI, norm=PowerNorm(0.5, 0, 1), extent=(0, last, *sites),
        origin="lower", aspect="auto", interpolation="none",
    )  # fmt: skip
    axes.set_ylabel("site $n$", labelpad=-2)
    return image


def _step(data: xr.Dataset) -> float:
    """Return the time that a snapshot stands for: one column, around the time of the snapshot."""
    times = data["snapshot_tau"].values
    return float(times[1]) if times.size > 1 else 1.0


def _width(data: xr.Dataset) -> float:
    """Return how wide the picture of one mu is."""
    return _step(data) * data.sizes["snapshot"]


def _starts(data: xr.Dataset) -> np.ndarray:
    """Return where the picture of each mu starts on the common axis of its row."""
    return (_width(data) + APART * _step(data)) * np.arange(data.sizes["mu"])


def _number_times(axes: Axes, data: xr.Dataset) -> None:
    """Number the start and the middle of each picture."""
    shown = [0.0, 0.5 * float(data["snapshot_tau"][-1])]
    axes.set_xticks([start + 0.5 * _step(data) + one for start in _starts(data) for one in shown],
                    [f"{one:g}" for _ in _starts(data) for one in shown])  # fmt: skip


def _name_strips(axes: Axes, data: xr.Dataset) -> None:
    middle, top = 0.5 * _width(data), axes.get_ylim()[1]
    for start, mu in zip(_starts(data), data["mu"].values, strict=True):
        axes.annotate(_name(mu), (start + middle, top), (0, 3), textcoords="offset points",
                      ha="center", fontsize=7.5)  # fmt: skip


def _name_curves(figure: Figure, mus: np.ndarray) -> None:
    lines = [
        Line2D([], [], color=colour, lw=1.6, label=_name(mu))
        for colour, mu in zip(LOOKS, mus, strict=False)
    ]
    figure.legend(handles=lines, loc="upper center", ncols=len(lines), columnspacing=1.2,
                  fontsize=7.5)  # fmt: skip
