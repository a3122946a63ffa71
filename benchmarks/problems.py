"""Which problems solvers are compared on: the paper's cases up to times that precede chaos.

An error says something about a solver only while the motion is regular, so each kind of motion
has a time at which errors are taken. The regimes are plain values: the workflow reads them without
importing kernels.
"""

from typing import NamedTuple

import numpy as np
from pendula.problem import PaperProblem


class Regime(NamedTuple):
    """A kind of motion: its cases, the time tau of the errors, and the error asked for."""

    cases: tuple[str, ...]
    horizon: float
    target: float


REGIMES = {
    "regular": Regime(("fig2_small", "fig3_small"), 50.0, 1e-10),
    "large": Regime(("fig2_large", "fig3_large"), 10.0, 1e-6),
    "unstable": Regime(("fig4_small", "fig4_large"), 5.0, 1e-6),
}
REGIME_OF = {case: name for name, regime in REGIMES.items() for case in regime.cases}


def until(problem: PaperProblem, end_time: float, **changes) -> PaperProblem:
    """Return the problem up to another time, with no outputs between its start and its end."""
    return problem.changed(end_time=end_time, output_step=end_time, snapshot_every=0, **changes)


def read_reference(dataset, horizon: float) -> np.ndarray:
    """Return the amplitudes (component, site) of a multiprecision study (an xarray.Dataset)."""
    at = dataset["snapshot_tau"].values == horizon
    re, im = dataset["amplitude"].isel(snapshot=at).squeeze("snapshot").values
    return re + 1j * im
