"""Where solvers are compared: the paper's cases up to times that precede chaos.

An error says something about a solver only while the motion is regular, so each kind of motion
has a horizon. Plain values, so that the workflow can read them without importing kernels.
"""

from typing import NamedTuple


class Regime(NamedTuple):
    """A kind of motion: its cases, how far they are followed, and the error asked for."""

    cases: tuple[str, ...]
    horizon: float
    target: float


REGIMES = {
    "regular": Regime(("fig2_small", "fig3_small"), 50.0, 1e-10),
    "large": Regime(("fig2_large", "fig3_large"), 10.0, 1e-6),
    "unstable": Regime(("fig4_small", "fig4_large"), 5.0, 1e-6),
}
REGIME_OF = {case: name for name, regime in REGIMES.items() for case in regime.cases}
