"""How the evenness of a solution is lost: the odd part of each case against time."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import by_case, style

LIGHT = "#f2a15f"


def gather(symmetry: xr.Dataset, lyapunov: xr.Dataset) -> xr.Dataset:
    """Return the odd parts, and what the odd tangent dynamics makes of the same perturbation."""
    stretch = lyapunov["stretch"].sel(parity="odd", drop=True)
    size = lyapunov["size"]
    log = stretch + np.log(symmetry.attrs["perturbation"] * size.isel(tau=0, drop=True) / size)
    predicted = np.exp(log.clip(max=0.0)).sel(tau=log["tau"] <= float(symmetry["tau"].max()))
    predicted.attrs = {"long_name": "odd part predicted by tangent dynamics", "units": "1"}
    names = ["rounded", "perturbed", "omega", "initial"]
    # on a time of its own, coarser than that of the runs
    return symmetry[names].assign(predicted=predicted.rename(tau="predicted_tau"))


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw one panel a case: rounding alone, odd perturbations, and their predicted growth."""
    return by_case.draw(data, _draw_panel, r"odd part / whole, $\ell^2$ norms")


def _draw_panel(axes: Axes, case: xr.Dataset) -> None:
    for member in range(case.sizes["member"]):
        curve = by_case.positive(case["perturbed"].isel(member=member))
        label = "from odd perturbations" if member == 0 else None
        axes.plot(curve["tau"], curve, color=LIGHT, lw=0.6, label=label)
    curve = by_case.positive(case["rounded"])
    axes.plot(curve["tau"], curve, color=style.BLUE, lw=1, label="by rounding alone")
    look = {"color": "black", "lw": 0.9, "dashes": (3, 1.5)}
    axes.plot(case["predicted_tau"], case["predicted"], label="tangent dynamics", **look)
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylim(1e-17, 10)
