"""What is proved of steady breathers."""

from pendula.ledger.changes import put
from pendula.ledger.claim import Control, claim
from pendula.ledger.criterion import AllOf, AtLeast, Below, Finding, judge
from pendula.ledger.cutoff import Cutoff

from .states import Verdict

SECTION = 7
PLACE = "Section 6, breathers"

PROVED = "certified/breathers"

NEAR = Cutoff(1e-12, "twelve correct digits of a state")


@claim(
    PLACE,
    "On the infinite chain a steady breather exists near each computed one, as proved.",
    (PROVED,),
    (
        Control(
            "a state inside the band of linear waves",
            lambda one: put("radius", one["wrong_radius"][0])(one),
        ),
        Control(
            "a state at another Omega than its own",
            lambda one: put("radius", one["wrong_radius"][1])(one),
        ),
    ),
)
def breathers_exist(proved) -> Finding:
    """Require that each state has a true one within a small radius, and report the next one."""
    measured = {
        "proofs": proved.sizes["proof"],
        "largest_radius": proved["radius"].max(skipna=False),
        "largest_contraction": proved["contraction"].max(skipna=False),
        "least_unique_radius": proved["unique_radius"].min(skipna=False),
        "largest_tail_factor": proved["tail_factor"].max(skipna=False),
    }
    criterion = AllOf(
        AtLeast(1, "proofs"),
        Below(NEAR, "largest_radius", says="largest proven distance to the true state"),
        Below(1.0, "largest_tail_factor", says="largest factor from site to site in the tail"),
    )
    return judge(measured, criterion)


@claim(
    PLACE,
    "On a finite chain some steady breathers are stable and others unstable, as proved.",
    (PROVED,),
    tuple(
        Control(f"spectra that are all {verdict.name.lower()}", put("stable", int(verdict)))
        for verdict in Verdict
    ),
)
def breathers_stable_or_not(proved) -> Finding:
    """Count what enclosed spectra prove; a spectrum that proves nothing is no verdict."""
    count = {one: (proved["stable"] == int(one)).sum() for one in Verdict}
    measured = {
        "proved_stable": count[Verdict.STABLE],
        "proved_unstable": count[Verdict.UNSTABLE],
        "undecided": count[Verdict.UNDECIDED],
        "largest_radius": proved["chain_radius"].max(skipna=False),
    }
    criterion = AllOf(
        AtLeast(1, "proved_stable", "proved_unstable"),
        Below(NEAR, "largest_radius", says="largest proven distance to the true state"),
    )
    open_ones = int(count[Verdict.UNDECIDED])
    return judge(measured, criterion, f"{open_ones} spectra decide nothing" if open_ones else "")
