"""Section 5: the energy by the paper's first solver."""

from itertools import product

import numpy as np

from pendula.ledger.changes import repeat
from pendula.ledger.claim import Control, checks, claim
from pendula.ledger.criterion import AtMost, Finding, UndecidableError, judge, undecided

from .solvers import EARLY, ORDER, STATED_DRIFT, UNKNOWNS

SECTION = 5


def drifts(solvers, size: str) -> Finding:
    """Return the finding of a claim on the energy over the cases with data of this size.

    The paper gives the order and the tolerances of the solver. It says neither to which time the
    order holds, nor whether it is that of H or relative to H(0), nor what the solver's unknowns
    are. A case decides if it keeps the order by all these readings, or exceeds it by all of them.
    """
    end = float(solvers["until"].sel(span="whole").min())
    if end < 2.0 * EARLY:
        raise UndecidableError(f"the runs end at tau = {end:g}, before {2.0 * EARLY:g}")
    allowed, measured, by_case = ORDER.value * STATED_DRIFT[size], {}, {}
    readings = product(UNKNOWNS.items(), solvers["of"].values, solvers["span"].values)
    for (unknowns, solver), of, span in readings:
        read = solvers["largest_drift"].sel(solver=solver, of=of, span=span)
        for case in (name for name in map(str, solvers["case"].values) if name.endswith(size)):
            words = (word for word in (span, unknowns, of) if word not in USUAL)
            name = "_".join([case, *words])
            measured[name] = float(read.sel(case=case))
            by_case.setdefault(case, []).append(measured[name] <= allowed)
    beyond = [case for case, kept in by_case.items() if not any(kept)]
    open_ = [case for case, kept in by_case.items() if any(kept) and not all(kept)]
    words = [f"it is larger by every definition in {named(beyond)}"] if beyond else []
    words += [f"the definition decides in {named(open_)}"] if open_ else []
    said = f"the drift may be {ORDER.value:g} times the stated one; {', and '.join(words)}"
    if (open_ and not beyond) or np.isnan([*measured.values()]).any():
        return undecided(measured, said)
    about = "largest drift of H, for each kind of drift, of unknowns and of time span"
    return judge(measured, AtMost(allowed, *measured, says=about), fails=said)


USUAL = ("complex", "absolute", "whole")
"""The readings that the names of the numbers leave out: those of the figures."""


def named(cases: list[str]) -> str:
    return ", ".join(cases)


def as_by(solver: str) -> dict:
    """Return what feeds the drifts of another solver as those of ode45 by either unknowns."""
    return repeat("solver", solver, at=list(UNKNOWNS.values()), names="largest_drift")


OF_HIGH_ORDER = Control(
    "runs of a solver of high order at tight tolerances", as_by("dop853"), confirms=True
)


@claim(
    "Section 5",
    "H is conserved to the order of 1e-6 for the smaller initial conditions.",
    checks("solvers"),
    controls=(OF_HIGH_ORDER,),
    on=("fig2_small", "fig3_small", "fig4_small"),
)
def energy_small(solvers) -> Finding:
    return drifts(solvers, "small")


@claim(
    "Section 5",
    "H is conserved to the order of 1e-4 for the larger initial conditions.",
    checks("solvers"),
    controls=(
        OF_HIGH_ORDER,
        Control(
            "runs of the second solver, whose scheme does not conserve H", as_by("crank_nicolson")
        ),
    ),
    on=("fig2_large", "fig3_large", "fig4_large"),
)
def energy_large(solvers) -> Finding:
    return drifts(solvers, "large")
