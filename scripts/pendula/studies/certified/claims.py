"""Claims decided by proofs: on the curves of Figs 2 to 4, and on steady breathers."""

import xarray as xr
from replication.ledger.changes import put
from replication.ledger.claim import ClaimControl, Origin, claim
from replication.ledger.criterion import (
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
)
from replication.ledger.cutoff import Cutoff

SECTION = 7
CURVES, BREATHERS = "checks/trust", "certified/breathers"

NEEDED = Cutoff(1e-9, "1 % of the relative tolerance, 1e-7, of the paper's solver")
NEAR = Cutoff(1e-12, "twelve correct digits of a state")


@claim(
    "Beyond the paper, Figs 2 to 4",
    "One computed trajectory of each case is proved to lie within 1e-9 of the true one.",
    (CURVES,),
    (
        ClaimControl(
            "the same trajectories one output late",
            lambda trust: trust.assign(distance=trust["late_distance"]),
        ),
    ),
    origin=Origin.OWN,
)
def curves_certified(trust: xr.Dataset) -> Finding:
    """Require small bounds, and norms that differ from the reference by at most their bounds."""
    proved = trust.where(trust["l2_bound"].notnull(), drop=True)
    if not proved.sizes["case"]:
        raise UndecidableError("no curve of these cases is proved")
    measured = {
        "curves": proved.sizes["case"],
        "largest_bound": proved["l2_bound"].max(),
        "largest_distance": proved["distance"].max(skipna=False),
    }
    criterion = AllOf(
        AtMost(NEEDED, "largest_bound", label="largest proven distance"),
        AtMost(
            1.0, "largest_distance", label="largest distance from the reference, over its bound"
        ),
    )
    return judge(measured, criterion)


@claim(
    "Section 6, breathers",
    "On the infinite chain a steady breather exists near each computed one, as proved.",
    (BREATHERS,),
    (
        ClaimControl(
            "a state inside the band of linear waves",
            lambda proved: put("radius", proved["wrong_radius"][0])(proved),
        ),
        ClaimControl(
            "a state at another Omega than its own",
            lambda proved: put("radius", proved["wrong_radius"][1])(proved),
        ),
    ),
    origin=Origin.OPEN,
)
def breathers_exist(proved: xr.Dataset) -> Finding:
    """Require, for each computed state, a proof that a true state lies within a small radius."""
    measured = {
        "proofs": proved.sizes["proof"],
        "largest_radius": proved["radius"].max(skipna=False),
    }
    near = Below(NEAR, "largest_radius", label="largest proven distance to the true state")
    return judge(measured, AllOf(AtLeast(1, "proofs"), near))
