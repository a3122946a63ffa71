"""Section 5: claims on the energy in runs by the paper's first solver."""

from itertools import product

import numpy as np
import xarray as xr
from replication.ledger.changes import repeat
from replication.ledger.claim import ClaimControl, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    AtMost,
    Finding,
    UndecidableError,
    judge,
    undecided,
)

from pendula.claims import checks

from .solvers import ORDER, STATED_DRIFT, UNKNOWNS

SECTION = 5
EARLIEST = 20.0
"""Runs that end before this tau show no drift that could be compared."""


def drifts(solvers: xr.Dataset, size: str) -> Finding:
    """Return the finding on the energy drift in the cases with initial data of this size.

    The paper gives the order of the drift and the tolerances of the solver. It does not say whether
    the drift is absolute or relative to H(0), or whether the solver's unknowns are complex or real.
    A case is decided only if all these definitions agree on whether its drift exceeds the order.
    """
    if (end := float(solvers["tau"][-1])) < EARLIEST:
        raise UndecidableError(f"the runs end at tau = {end:g}, before {EARLIEST:g}")
    allowed, measured, by_case = ORDER.value * STATED_DRIFT[size], {}, {}
    for (unknowns, solver), reading in product(UNKNOWNS.items(), solvers["of"].values):
        read = solvers["largest_drift"].sel(solver=solver, of=reading)
        for case in (name for name in map(str, solvers["case"].values) if name.endswith(size)):
            # names omit "complex" and "absolute", which the figures use
            words = (word for word in (unknowns, reading) if word not in ("complex", "absolute"))
            name = "_".join([case, *words])
            measured[name] = float(read.sel(case=case))
            by_case.setdefault(case, []).append(measured[name] <= allowed)
    beyond = [case for case, within in by_case.items() if not any(within)]
    open_ = [case for case, within in by_case.items() if any(within) and not all(within)]
    each = "absolute or relative, with complex or real unknowns"
    words = [f"it is larger in {', '.join(beyond)} ({each})"] if beyond else []
    words += [f"the answer depends on the definition in {', '.join(open_)}"] if open_ else []
    caveat = f"we allow {ORDER.value:g} times the stated drift; {', and '.join(words)}"
    label = "largest drift of H, for each kind of drift and of unknowns"
    if (open_ and not beyond) or np.isnan([*measured.values()]).any():
        relative = [name for name in measured if name.endswith("relative")]
        largest = max(measured, key=measured.get)
        either = AllOf(AtMost(allowed, *relative), Above(allowed, largest))
        return undecided(measured, caveat, either)
    return judge(measured, AtMost(allowed, *measured, label=label), fails=caveat)


def as_by(solver: str) -> dict:
    """Return a change that replaces the drifts of ode45 by those of another solver."""
    return repeat("solver", solver, at=list(UNKNOWNS.values()), names="largest_drift")


OF_HIGH_ORDER = ClaimControl(
    "runs of a solver of high order at tight tolerances", as_by("taylor"), confirms=True
)


@claim(
    "Section 5",
    "H is conserved to the order of 1e-6 for the smaller initial conditions.",
    checks("solvers"),
    controls=(OF_HIGH_ORDER,),
    on=("fig2_small", "fig3_small", "fig4_small"),
)
def energy_small(solvers: xr.Dataset) -> Finding:
    return drifts(solvers, "small")


@claim(
    "Section 5",
    "H is conserved to the order of 1e-4 for the larger initial conditions.",
    checks("solvers"),
    controls=(
        OF_HIGH_ORDER,
        ClaimControl(
            "runs of the second solver, whose scheme does not conserve H", as_by("crank_nicolson")
        ),
    ),
    on=("fig2_large", "fig3_large", "fig4_large"),
)
def energy_large(solvers: xr.Dataset) -> Finding:
    return drifts(solvers, "large")
