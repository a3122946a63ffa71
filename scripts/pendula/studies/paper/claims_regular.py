"""Section 6: the claim that stable chains move regularly."""

import xarray as xr
from replication.ledger.changes import exchange
from replication.ledger.claim import ClaimControl, claim
from replication.ledger.criterion import AtMost, Finding, judge

from pendula.claims import checks
from pendula.models.linear_chain import gamma_0

SECTION = 5

GAMMA = EPSILON = 1.0
"""The paper's drive and coupling, the same in all its cases."""


@claim(
    "Section 6",
    "Stable dynamics is relatively simple; that of unstable chains is more interesting.",
    checks("lyapunov", "cases"),
    controls=(
        ClaimControl("exponents of the cases in reverse order", {"lyapunov": exchange("case")}),
    ),
)
def stable_is_regular(lyapunov: xr.Dataset, cases: xr.Dataset) -> Finding:
    grown = lyapunov["chaotic"].sel(case=cases["case"]) == 1
    covered = cases["region"] != "none"
    measured = {
        "cases_a_theorem_covers": covered.sum(),
        "chaotic_among_them": (grown & covered).sum(),
        "others": (~covered).sum(),
        "regular_among_them": (~grown & ~covered).sum(),
    }
    label = "chaotic cases that Theorem 1 or 2 covers, and regular cases that neither covers"
    criterion = AtMost(0, "chaotic_among_them", "regular_among_them", label=label)
    at_rest = gamma_0(cases["omega"].values, EPSILON) > GAMMA
    names = ", ".join(map(str, cases["case"].values[at_rest & (grown & ~covered).values]))
    caveat = f"{names} is chaotic although the chain at rest is stable" if names else ""
    return judge(measured, criterion, caveat)
