"""Figure 1: a drawing of the chain, pairs of pendula on common strings linked by springs."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from latticode.numerics.elementary import cos, sin
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from replication.variables import REGULAR

PAIRS, ANGLES = 3, (-0.5, 0.35)
SPACING, LENGTH, DEPTH, OVERHANG = 1.75, 1.0, 1.3, 0.5
COILS, COIL_RADIUS, LEAD = 9, 0.08, 0.2
COLOURS = {"x": style.RED, "y": style.BLUE}  # A_n is the amplitude of x_n
CAPTION = (
    "The chain, redrawn after Fig 1 of the paper. Pairs of pendula xₙ (red) and yₙ (blue) hang "
    "from common strings, whose coupling D(t) is driven. Springs of strength C couple "
    "neighbouring pairs. Dashed lines show the pendula at rest."
)


def gather_chain() -> xr.Dataset:
    """Return the positions on the page of all pairs, the central one turned by ANGLES.

    The angles decrease away from the centre: this is a sketch, not a solution.
    """
    offsets = np.arange(PAIRS) - PAIRS // 2
    place = SPACING * offsets[:, None]
    turned = np.asarray(ANGLES) * cos(np.pi * offsets[:, None] / (PAIRS + 1))
    strings = _project(place, np.array([-OVERHANG, DEPTH + OVERHANG]), 0)
    pivots = _project(place, np.array([0, DEPTH]), 0)

    def hang(turned: np.ndarray) -> np.ndarray:
        return _project(place, np.array([0, DEPTH]) + LENGTH * sin(turned), -LENGTH * cos(turned))

    hung = ("offset", "pendulum", "axis")
    link = ("link", "pendulum", "point", "axis")
    return xr.Dataset(
        {
            "string": (("offset", "end", "axis"), strings, _long_name("ends of a common string")),
            "pivot": (hung, pivots, _long_name("point from which a pendulum hangs")),
            "bob": (hung, hang(turned), _long_name("bob of a pendulum")),
            "rest": (hung, hang(0 * turned), _long_name("bob of a pendulum at rest")),
            "spring": (link, pivots[:-1, :, None] + _coil(), _long_name("torsional spring")),
        },
        {
            "offset": ("offset", offsets, _long_name("place in the chain relative to n")),
            "pendulum": ("pendulum", ["x", "y"], _long_name("pendulum of the pair")),
            "axis": ("axis", ["across", "up"], _long_name("direction on the page")),
        },
        {"caption": CAPTION, **REGULAR},
    )


def _long_name(title: str) -> dict[str, str]:
    return {"long_name": title}


def _project(along: np.ndarray, back: np.ndarray, up: np.ndarray | float) -> np.ndarray:
    """Return points on the page: points farther back appear higher and to the right."""
    return np.stack(np.broadcast_arrays(along + 0.6 * back, up + 0.42 * back), axis=-1)


def _coil() -> np.ndarray:
    """Return the points of a coil along the chain, from one pivot, at the origin, to the next."""
    turn = np.linspace(0, 2 * np.pi * COILS, 24 * COILS + 1)
    share = LEAD + (1 - 2 * LEAD) * turn / turn[-1]
    across = SPACING * share + 0.45 * COIL_RADIUS * (cos(turn) - 1)
    coil = np.stack([across, COIL_RADIUS * sin(turn)], axis=-1)
    return np.concatenate([[[0, 0]], coil, [[SPACING, 0]]])


@style.styled
def draw_chain(data: xr.Dataset) -> Figure:
    """Draw the chain from the back to the front, with the names of the angles and couplings."""
    figure = style.new_figure(style.WIDTH * 0.7, 1.95)
    axes = figure.subplots()
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0.02, 0.1)
    _draw_row(axes, data.sel(pendulum="y"))
    for string in data["string"].values:
        axes.plot(*string.T, color="black", linewidth=1.2)
    _draw_row(axes, data.sel(pendulum="x"))
    coil = data["spring"].isel(link=-1, pendulum=1)
    spring = [float(coil[:, 0].mean()), float(coil[:, 1].max())]
    string = data["string"].isel(offset=0, end=1).values
    names = {"springs: coupling $C$": spring, "common strings: coupling $D(t)$": string}
    line = {"arrowstyle": "-", "linewidth": 0.6, "shrinkA": 1, "shrinkB": 2}
    for name, point in names.items():
        axes.annotate(name, point, (point[0], string[1] + 0.25), ha="center", arrowprops=line)
    return figure


def _draw_row(axes: Axes, row: xr.Dataset) -> None:
    pendulum = str(row["pendulum"].values)
    for spring in row["spring"].values:
        axes.plot(*spring.T, color="0.35", linewidth=0.8)
    for offset, pendulum_data in row.groupby("offset"):
        pivot, bob, rest_position = (
            pendulum_data[name].values.squeeze() for name in ("pivot", "bob", "rest")
        )
        axes.plot(*np.stack([pivot, rest_position]).T, color="0.5", linewidth=0.7, dashes=(3, 2))
        axes.plot(*np.stack([pivot, bob]).T, color=COLOURS[pendulum], linewidth=1.5)
        axes.plot(*bob, "o", color=COLOURS[pendulum], markersize=9, markeredgecolor="black")
        axes.plot(*pivot, "o", color="black", markersize=2.5)
        name = f"${pendulum}_{{n{offset:+d}}}$" if offset else f"${pendulum}_n$"
        # the name is on the side of the bob that faces away from the dashed line
        side, ha = (1, "left") if bob[0] >= rest_position[0] else (-1, "right")
        axes.annotate(
            name,
            bob,
            (7 * side, 0),
            textcoords="offset points",
            ha=ha,
            va="center",
            fontsize=style.WITH_INDICES,
        )
