"""What is proved of steady breathers."""

from pendula.ledger.changes import put
from pendula.ledger.claim import Control, claim
from pendula.ledger.criterion import AllOf, AtLeast, Below, Finding, judge
from pendula.ledger.cutoff import Cutoff

from .states import Verdict

SECTION = 7
PLACE = "Section 6, breathers"

PROVED = "certified/breathers"

NEAR = Cutoff(1e-12, "a state is told to twelve digits")


@claim(
    PLACE,
    "Steady breathers exist on the infinite chain: a theorem for each of the states computed.",
    (PROVED,),
    (
        Control(
            "a state tested inside the band of waves",
            lambda one: put("radius", one["wrong_radius"][0])(one),
        ),
        Control(
            "a state tested at an Omega beside its own",
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
        Below(NEAR, "largest_radius", says="largest distance to the true state"),
        Below(1.0, "largest_tail_factor", says="decay from site to site"),
    )
    return judge(measured, criterion)


@claim(
    PLACE,
    "Some steady breathers on a finite chain are stable and others are not, as theorems.",
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
        Below(NEAR, "largest_radius", says="largest distance to the true state of the chain"),
    )
    open_ones = int(count[Verdict.UNDECIDED])
    return judge(measured, criterion, f"{open_ones} spectra leave it open" if open_ones else "")
