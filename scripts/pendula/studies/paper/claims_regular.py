"""Sections 5 and 6: what stays bounded, what is regular, and what the energy tells of errors."""

import numpy as np

from pendula.ledger.chaotic import chaotic
from pendula.ledger.claim import LARGE, SMALL, cases_reversed, checks, claim, wrong_check, wrong_run
from pendula.ledger.criterion import AtMost, Finding, UndecidableError, judge
from pendula.measures.norms import constants, total_power
from pendula.models.bounds import theorem_3_bound
from pendula.models.linear_chain import gamma_0

SECTION = 5

GAMMA = EPSILON = 1.0
"""Of all cases of the paper."""


def of_regular_cases(check):
    """Return a check of the cases alone that small data keep regular."""
    return check.sel(case=["fig2_small", "fig3_small"])


@claim(
    "Section 5",
    "The conservation of H is a measure of the numerical error.",
    checks("solvers", "trust"),
    controls=(
        wrong_check(
            "the regular cases alone",
            confirms=True,
            solvers=of_regular_cases,
            trust=of_regular_cases,
        ),
    ),
)
def energy_measures_error(solvers, trust) -> Finding:
    shared = [name for name in trust["solver"].values if name in solvers["solver"].values]
    kept = solvers["kept"].sel(span="whole", solver=shared) == 1
    horizon = trust["horizon"].sel(level="visible", solver=shared)
    if not np.isfinite(horizon.values).any() and np.isnan(horizon.values).any():
        raise UndecidableError("no reference of these cases tells the errors")
    off = (kept & np.isfinite(horizon)).any("solver")
    measured = {"runs_that_keep_H": kept.sum(), "of_them_off": (kept & np.isfinite(horizon)).sum()}
    fails = (
        f"runs of {', '.join(map(str, off['case'].values[off.values]))} keep H to the stated order"
        " and have norms that are off by 1 % and more: H feels neither a shift in time nor chaos"
    )
    return judge(measured, AtMost(0, "of_them_off"), fails=fails)


@claim(
    "Section 6",
    "Stable dynamics is relatively simple, that of unstable chains is more interesting.",
    checks("lyapunov", "cases"),
    controls=(
        wrong_check(
            "the exponents of the cases in reverse order",
            lyapunov=cases_reversed,
        ),
    ),
)
def stable_is_regular(lyapunov, cases) -> Finding:
    grown = chaotic(lyapunov).sel(case=cases["case"])
    covered = cases["region"] != "none"
    measured = {
        "cases_a_theorem_covers": covered.sum(),
        "chaotic_among_them": (grown & covered).sum(),
        "others": (~covered).sum(),
        "regular_among_them": (~grown & ~covered).sum(),
    }
    criterion = AtMost(0, "chaotic_among_them", "regular_among_them")
    at_rest = gamma_0(cases["omega"].values, EPSILON) > GAMMA
    names = ", ".join(map(str, cases["case"].values[at_rest & (grown & ~covered).values]))
    caveat = f"{names} is chaotic though small data at its Omega are stable" if names else ""
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, before Fig 5",
    "By Theorem 3 the solution in the finite chain stays bounded.",
    (*SMALL, *LARGE),
    controls=(
        wrong_run(
            "the bound of a chain of three sites",
            fig4_small=lambda run: run.assign_attrs(half_width=1),
        ),
    ),
)
def finite_bound(*trajectories) -> Finding:
    ratios = []
    for ds in trajectories:
        sites = 2 * int(ds.attrs["half_width"]) + 1
        bound = theorem_3_bound(float(ds["energy"][0]), sites, constants(ds))
        ratios.append(total_power(ds).max() / bound)
    return judge({"largest": max(ratios)}, AtMost(1.0, "largest", says="largest P over C_N"))
