"""The problems on which solvers are compared: the paper's cases, up to times before chaos.

Errors characterise a solver only while the motion is regular, so each kind of motion has its own
time at which errors are measured. The workflow reads regimes, so this module imports no kernels.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from pendula.problem import PaperProblem

if TYPE_CHECKING:
    import xarray as xr


class Regime(NamedTuple):
    """A kind of motion: its cases, the time tau of the errors, and the error of the comparison."""

    cases: tuple[str, ...]
    horizon: float
    target: float


REGIMES = {
    "regular": Regime(("fig2_small", "fig3_small"), 50.0, 1e-10),
    "large": Regime(("fig2_large", "fig3_large"), 10.0, 1e-6),
    "unstable": Regime(("fig4_small", "fig4_large"), 5.0, 1e-6),
}
REGIME_OF = {case: name for name, regime in REGIMES.items() for case in regime.cases}


def until(problem: PaperProblem, end_time: float, **changes: Any) -> PaperProblem:
    """Return the problem with another end time, without outputs before it, and with `changes`."""
    return problem.changed(end_time=end_time, output_step=end_time, snapshot_every=0, **changes)


def read_reference(dataset: "xr.Dataset", horizon: float) -> np.ndarray:
    """Return the amplitudes (component, site) of a multiprecision reference at tau = `horizon`."""
    at = dataset["snapshot_tau"].values == horizon
    re, im = dataset["amplitude"].isel(snapshot=at).squeeze("snapshot").values
    return re + 1j * im
