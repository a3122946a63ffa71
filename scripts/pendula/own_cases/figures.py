"""Figures of a user's cases and sweeps: the figures of any run, with the paper's symbols."""

import numpy as np
import xarray as xr
from latticode.drawing import runs
from latticode.drawing.runs import Naming, gather_sweep  # noqa: F401, for `draw_sweep`
from matplotlib.figure import Figure

from pendula.models.pendula import frequency
from pendula.problem import PENDULA

EIGHT = 8.0
"""Outputs per period of the pendula that resolve their swing."""
SYMBOLS = {
    "omega": r"\Omega",
    "gamma": r"\gamma",
    "epsilon": r"\epsilon",
    "half_width": "M",
    "mu": r"\mu",
}
FEW_OUTPUTS = (
    " There are fewer than eight outputs in a period of the pendula: use the upper edge of the "
    "curves, or give a shorter output_step."
)
SWING_CAPTION = (
    "Amplitudes √(x² + (dx/dt / ω)²) of the angles over time and sites: xₙ on the left and yₙ on "
    "the right."
)


def naming_of(data: xr.Dataset) -> Naming:
    """Return the symbols in titles; the initial data of pendula are amplitudes A and B."""
    return Naming(SYMBOLS, ("A", "B") if data.attrs.get("model") == PENDULA else ())


def gather_norms(run: xr.Dataset, checks: xr.Dataset | None = None) -> xr.Dataset:
    """Return the norms of a trajectory, and of the second run in its checks."""
    drawn, attributes = runs.gather_norms(run, checks), run.attrs
    if attributes.get("model") != PENDULA:
        return drawn
    period = np.pi * attributes["mu"] ** 2 / frequency(attributes["omega"], attributes["mu"])
    few = bool(attributes["output_step"] > period / EIGHT)
    return drawn.assign_attrs(caption=drawn.attrs["caption"] + FEW_OUTPUTS * few)


def draw_norms(data: xr.Dataset) -> Figure:
    """Draw l-infinity (left) and l2 (right), A red and B blue."""
    return runs.draw_norms(data, naming_of(data))


def gather_spacetime(run: xr.Dataset) -> xr.Dataset:
    """Return the moduli of a trajectory over the times of its snapshots."""
    drawn = runs.gather_spacetime(run)
    return drawn.assign_attrs(caption=SWING_CAPTION) if run.attrs.get("model") == PENDULA else drawn


def draw_spacetime(data: xr.Dataset) -> Figure:
    """Draw |A_n| left and |B_n| right, or all fields of a model, on one scale of colours."""
    return runs.draw_spacetime(data, naming_of(data))


def draw_sweep(data: xr.Dataset) -> Figure:
    """Draw l-infinity (left, blue squares) and l2 (right, red dots); means are hollow."""
    return runs.draw_sweep(data, naming_of(data))
