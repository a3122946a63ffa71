"""Section 5: the energy by the paper's first solver, and its figures by the second one."""

import numpy as np

from pendula.ledger.claim import CHANGE, FEWEST, checks, claim
from pendula.ledger.criterion import AtMost, Below, Finding, UndecidableError, judge

SECTION = 5

PAIR = "ode45 - crank_nicolson"
"""The paper's two solvers."""


def drifts(solvers, size: str) -> Finding:
    """Return the finding of a claim on the energy over the cases with data of this size."""
    cases = [str(case) for case in solvers["case"].values if str(case).endswith(size)]
    if not cases:
        raise UndecidableError(f"no case has {size} data")
    chosen = solvers.sel(case=cases, solver="ode45")
    largest_drifts = chosen["largest_drift"].sel(span="whole").values
    measured = dict(zip(cases, largest_drifts, strict=True))
    limit = float(chosen["allowed_drift"].values.max())
    criterion = AtMost(limit, *cases, says="largest |H - H(0)|")
    failing = ", ".join(criterion.failing(measured))
    fails = f"not for {failing}, by a solver whose tolerances the paper does not give"
    return judge(measured, criterion, fails=fails)


@claim(
    "Section 5",
    "H is conserved to the order of 1e-6 for the smaller data.",
    checks("solvers"),
)
def energy_small(solvers) -> Finding:
    return drifts(solvers, "small")


@claim(
    "Section 5",
    "H is conserved to the order of 1e-4 for the larger data.",
    checks("solvers"),
)
def energy_large(solvers) -> Finding:
    return drifts(solvers, "large")


@claim(
    "Section 5, end",
    "Figs 2 to 4 come out of the second solver without significant differences.",
    checks("solvers"),
)
def second_solver(solvers) -> Finding:
    pair = solvers.sel(pair=PAIR)
    times = {
        str(case): float(pair["divergence_time"].sel(case=case)) for case in pair["case"].values
    }
    measured = {f"divergence_{case}": time for case, time in times.items()}
    measured["largest_late_difference"] = pair["late_difference"].max()
    apart = {case: time for case, time in times.items() if np.isfinite(time)}
    caveat = ""
    if apart:
        level, first = 100 * float(solvers["visible"]), min(apart.values())
        caveat = (
            f"{', '.join(apart)} differ by {level:g} % from tau = {first:.3g} on; their means agree"
        )
    says = "difference of the mean norms of the second half"
    return judge(measured, Below(CHANGE, "largest_late_difference", says=says), caveat)


@claim(
    "Section 5, end",
    "So do Figs 5 and 6.",
    checks("solvers"),
)
def second_solver_sweeps(solvers) -> Finding:
    measured = {}
    for name in map(str, solvers["sweep"].values):
        difference = solvers["sweep_difference"].sel(sweep=name, statistic="max")
        known = difference.dropna("half_width", how="all")
        if known.sizes["half_width"] < FEWEST:
            raise UndecidableError("the sweeps have fewer than six half-widths")
        measured[f"largest_{name}"] = known.max()
        measured[f"median_{name}"] = known.median()
    largest = [name for name in measured if name.startswith("largest_")]
    criterion = Below(CHANGE, *largest, says="largest difference of a point")
    visible = [name for name in largest if measured[name] > float(solvers["visible"])]
    apart = criterion.failing(measured)
    typical = max((measured[_median(name)] for name in apart), default=0.0)
    fails = f"points of {_sweeps(apart)} differ by more, half of them below {100 * typical:.2g} %"
    caveat = f"points of {_sweeps(visible)} differ visibly: the motion is chaotic there"
    return judge(measured, criterion, caveat if visible else "", fails)


def _median(name: str) -> str:
    return f"median_{name.removeprefix('largest_')}"


def _sweeps(names: list[str]) -> str:
    return ", ".join(name.removeprefix("largest_") for name in names)
