"""Until when each solver's norms are the true ones, in the six cases."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import by_case, style
from pendula.measures.divergence import horizons

MARKERS = {"ode45": "o", "crank_nicolson": "s", "dop853": "^", "taylor": "D"}


def gather(trajectories: by_case.Trajectories, references: dict[str, xr.Dataset]) -> xr.Dataset:
    """Return by case and solver how far the norms are from the truth, and when they are lost."""
    cases, solvers = by_case.names(trajectories)
    curves = {
        case: horizons({name: trajectories[case, name] for name in solvers}, references[case])
        for case in cases
    }
    data = by_case.stack(
        trajectories, {case: found["difference"] for case, found in curves.items()}
    )
    case = xr.Variable("case", cases, data["case"].attrs)
    data["horizon"] = xr.concat([found["horizon"] for found in curves.values()], case)
    data["size"] = next(iter(curves.values()))["size"]
    return data


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a solver, a mark where its curve is visibly another."""
    return by_case.draw(data, _draw_panel, "error relative to full scale")


def _draw_panel(axes: Axes, case: xr.Dataset) -> None:
    visible = float(case["size"].sel(level="visible"))
    for solver in case["solver"].values:
        curve = by_case.positive(case["difference"].sel(solver=solver))
        look = {"color": style.COLOURS[solver], "marker": MARKERS[solver]}
        axes.plot(
            curve["tau"],
            curve,
            label=style.SOLVER_NAMES[solver],
            markevery=[],
            markersize=4,
            **look,
        )
        lost = float(case["horizon"].sel(solver=solver, level="visible"))
        axes.plot(lost, visible, **look, markeredgecolor="white", zorder=3)
    axes.axhline(visible, color="0.45", dashes=(4, 2), lw=1, label=f"{visible:.0%} (visible)")
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylim(1e-17, 3.0)
