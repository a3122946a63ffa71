"""Figure 1: a drawing of the chain, pairs of pendula on common strings linked by springs."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import style

SPACING, LENGTH, DEPTH, OVERHANG = 1.75, 1.0, 1.3, 0.5
COILS, COIL_RADIUS, LEAD = 9, 0.07, 0.2
COLOURS = {"x": style.COLOURS["A"], "y": style.COLOURS["B"]}  # A_n is the amplitude of x_n
GREY = "0.35"


def gather(pairs: int = 5, angles: Sequence[float] = (0.55, -0.4)) -> xr.Dataset:
    """Return the points, on the page, of `pairs` pairs, the central one turned by `angles`.

    The others are turned less, the farther they are from it: a picture, not a solution.
    """
    offsets = np.arange(pairs) - pairs // 2
    place = SPACING * offsets[:, None]
    turned = np.asarray(angles) * np.cos(np.pi * offsets[:, None] / (pairs + 1))
    back = np.array([0, DEPTH])
    pivots = _project(place, back, 0)
    rests = _project(place, back, -LENGTH)
    bobs = _project(place, back + LENGTH * np.sin(turned), -LENGTH * np.cos(turned))
    strings = _project(place, np.array([-OVERHANG, DEPTH + OVERHANG]), 0)
    pendulum = ("offset", "member", "axis")
    data = xr.Dataset(
        {
            "pivot": (pendulum, pivots, _about("point from which a pendulum hangs")),
            "bob": (pendulum, bobs, _about("bob of a pendulum")),
            "rest": (pendulum, rests, _about("bob of a pendulum at rest")),
            "string": (("offset", "end", "axis"), strings, _about("ends of a common string")),
            "spring": (("link", "member", "point", "axis"), _springs(pivots), _about("spring")),
        },
        {
            "offset": ("offset", offsets, _about("place in the chain relative to n")),
            "member": ("member", ["x", "y"], _about("pendulum of the pair")),
            "axis": ("axis", ["across", "up"], _about("direction on the page")),
        },
    )
    return data


def _about(title: str) -> dict[str, str]:
    return {"long_name": title, "units": "1"}


def _project(along: np.ndarray, back: np.ndarray, up: np.ndarray | float) -> np.ndarray:
    """Return points on the page: what lies farther back is shown higher and to the right."""
    across, height = np.broadcast_arrays(along + 0.6 * back, up + 0.42 * back)
    return np.stack([across, height], axis=-1)


def _springs(pivots: np.ndarray) -> np.ndarray:
    """Return coils along the chain from each pivot to the next, with straight ends."""
    turn = np.linspace(0, 2 * np.pi * COILS, 40 * COILS + 1)
    share = LEAD + (1 - 2 * LEAD) * turn / turn[-1]
    coil = np.stack([share * SPACING - 0.6 * COIL_RADIUS * (1 - np.cos(turn)), COIL_RADIUS * np.sin(turn)], axis=-1)
    spring = np.concatenate([[[0, 0]], coil, [[SPACING, 0]]])
    return pivots[:-1, :, None, :] + spring


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw the chain from the back to the front, with the names of the angles and couplings."""
    figure = style.new_figure(style.DOUBLE, 2.6)
    axes = figure.subplots()
    axes.set_aspect("equal")
    axes.set_axis_off()
    for member in ("y", "x"):
        _draw_row(axes, data.sel(member=member), COLOURS[member])
    for string in data["string"]:
        axes.plot(*string.values.T, color="black", lw=1.1, zorder=1.5)
    _name_pendula(axes, data)
    _name_couplings(axes, data)
    return figure


def _draw_row(axes: Axes, row: xr.Dataset, colour: str) -> None:
    for spring in row["spring"]:
        axes.plot(*spring.values.T, color=GREY, lw=0.8)
    for pivot, bob, rest in zip(row["pivot"], row["bob"], row["rest"], strict=True):
        pivot, bob, rest = pivot.values, bob.values, rest.values
        axes.plot(*zip(pivot, rest, strict=True), color="0.6", lw=0.7, dashes=(3, 2))
        axes.plot(*zip(pivot, bob, strict=True), color=colour, lw=1.6)
        axes.plot(*bob, "o", color=colour, ms=9, mec="black", mew=0.6)
        axes.plot(*pivot, "o", color="black", ms=2.5, zorder=3)
