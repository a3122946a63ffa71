"""Section 5: how well the simulations conserve the energy."""

import numpy as np

from pendula.ledger.row import LARGE, SMALL, claim
from pendula.ledger.verdicts import Finding, judge

# ASSUME: "up to the order of 10^-k" allows up to twice that number, as in the table of solvers.
ORDER = 2.0


def drift(trajectory) -> float:
    """Return the largest |H - H(0)| of a trajectory."""
    energy = trajectory["energy"].values
    return float(np.abs(energy - energy[0]).max())


def energy_kept(order: float, trajectories) -> Finding:
    """Return the finding of an energy claim over the cases it names."""
    measured = {str(ds.attrs["case"]): drift(ds) for ds in trajectories}
    failing = [name for name, value in measured.items() if value > ORDER * order]
    fails = f"not for {', '.join(failing)}, by a solver whose tolerances the paper does not give"
    return judge(measured, f"|H - H(0)| <= {ORDER * order:.0e}", not failing, fails=fails)


@claim(
    "energy_small",
    "Section 5",
    "H is conserved to the order of 1e-6 for the smaller data.",
    SMALL,
)
def energy_small(*trajectories) -> Finding:
    """H is kept to the order of 1e-6 for the smaller data."""
    return energy_kept(1e-6, trajectories)


@claim(
    "energy_large",
    "Section 5",
    "H is conserved to the order of 1e-4 for the larger data.",
    LARGE,
)
def energy_large(*trajectories) -> Finding:
    """H is kept to the order of 1e-4 for the larger data."""
    return energy_kept(1e-4, trajectories)
