"""How well each solver conserves the energy in the six cases, beside the paper's claim."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import by_case, style

CLAIMS = {"small": 1e-6, "large": 1e-4}
"""The paper's bounds, for the cases whose names end so."""


def gather(trajectories: by_case.Trajectories) -> xr.Dataset:
    """Return |H(tau) - H(0)| by case and solver, and what the paper claims of it."""
    cases, solvers = by_case.names(trajectories)
    solver = xr.Variable("solver", solvers, {"long_name": "solver", "units": "1"})
    curves = {
        case: xr.concat([_drift(trajectories[case, name]) for name in solvers], solver)
        for case in cases
    }
    data = by_case.stack(trajectories, curves)
    claims = [CLAIMS.get(case.rpartition("_")[2], float("nan")) for case in cases]
    data["claim"] = ("case", claims, {"long_name": "drift claimed by the paper", "units": "1"})
    return data


def _drift(trajectory: xr.Dataset) -> xr.DataArray:
    energy = trajectory["energy"]
    drift = abs(energy - energy.isel(tau=0, drop=True)).rename("drift")
    return drift.assign_attrs(long_name="drift of the energy |H(tau) - H(0)|", units="1")


DRAWN = ["ode45", "dop853", "crank_nicolson"]  # the noisy curve below the smooth one


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a solver, and the claim as a dashed line."""
    return by_case.draw(data, _draw_panel, r"$|H(\tau) - H(0)|$")


def _draw_panel(axes: Axes, case: xr.Dataset) -> None:
    for solver in sorted(case["solver"].values, key=DRAWN.index):
        curve = by_case.positive(case["drift"].sel(solver=solver))
        axes.plot(
            curve["tau"],
            curve,
            color=style.COLOURS[solver],
            label=style.SOLVER_NAMES[solver],
        )
    axes.axhline(float(case["claim"]), color="0.45", dashes=(4, 2), lw=1, label="paper's claim")
    axes.set_xlim(0, float(case["tau"].max()))
