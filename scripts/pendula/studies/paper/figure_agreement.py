"""Until when two solvers draw the same curves: the paper's two solvers, and one of high order."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import by_case, style
from pendula.measures.divergence import LEVELS, difference, first_above

VISIBLE = LEVELS["visible"]

# two of the curves nearly coincide: the first is a broad light band under the thin second
PAIRS = {
    "ode45 - crank_nicolson": {"color": "#f2b824", "linewidth": 2.4, "marker": "s"},
    "crank_nicolson - dop853": {"color": "#111111", "linewidth": 0.6, "marker": "^"},
    "ode45 - dop853": {"color": "#16876b", "linewidth": 0.6, "marker": "o"},
}
MARK_SIZES = {"s": 8, "^": 4.5, "o": 4.5}


def gather(trajectories: by_case.Trajectories) -> xr.Dataset:
    """Return by case and pair of solvers how far their norms differ, and when that is visible.

    What a difference is, trust.difference says.
    """
    cases, _ = by_case.names(trajectories)
    pair = xr.Variable("pair", list(PAIRS), {"long_name": "pair of solvers", "units": "1"})
    curves = {}
    for case in cases:
        pairs = ([trajectories[case, solver] for solver in name.split(" - ")] for name in PAIRS)
        curves[case] = xr.concat([difference(*both) for both in pairs], pair)
    data = by_case.stack(trajectories, curves)
    parting = first_above(data["difference"], VISIBLE)
    about = {"long_name": "first tau at which the difference is visible", "units": "1"}
    data["parting"] = parting.assign_attrs(about)
    data["visible"] = ((), VISIBLE, {"long_name": "visible difference", "units": "1"})
    return data


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a pair, a mark where the pair parts for the eye."""
    return by_case.draw(data, _draw_panel, "relative difference")


def _draw_panel(axes: Axes, case: xr.Dataset) -> None:
    visible = float(case["visible"])
    for pair in case["pair"].values:
        curve = by_case.positive(case["difference"].sel(pair=pair))
        label = " / ".join(style.SOLVER_NAMES[solver] for solver in pair.split(" - "))
        look = PAIRS[pair]
        axes.plot(curve["tau"], curve, label=label, markevery=[], **look)
        parting = float(case["parting"].sel(pair=pair))
        size = MARK_SIZES[look["marker"]]
        axes.plot(parting, visible, **look, markersize=size, markeredgecolor="white", zorder=3)
    axes.axhline(visible, color="0.45", dashes=(4, 2), lw=1, label=f"{visible:.0%} (visible)")
    axes.set_xlim(0, float(case["tau"].max()))
