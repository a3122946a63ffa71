"""What is proved of the curves of small data, and whether the proof notices what is wrong."""

from pendula.ledger.claim import Control, claim
from pendula.ledger.criterion import AllOf, AtLeast, AtMost, Finding, judge
from pendula.ledger.cutoff import Cutoff

SECTION = 7
PLACE = "Figs 2 and 3, small data"

EIGHT, MINUS_FOUR, WRONG = "certified/fig2_small", "certified/fig3_small", "certified/wrong/curve"
NEEDED = Cutoff(1e-9, "a hundredth of the relative tolerance, 1e-7, of the paper's solver")


def shifted(certified):
    """Return curves that lie twice their bound away from where they are."""
    away = certified["reference_distance"] + 2.0 * certified["bound"]
    return certified.assign(reference_distance=away)


@claim(
    PLACE,
    "The computed curves are proved to be the true ones to within a hundredth of the tolerance.",
    (EIGHT, MINUS_FOUR),
    (Control("a curve of (4) with a drive that is larger by a millionth", {MINUS_FOUR: WRONG}),),
)
def curves_certified(eight, minus_four) -> Finding:
    """Read the bounds at the end of the runs."""
    bounds = {
        "bound_at_8": float(eight["bound"].max()),
        "bound_at_minus_4": float(minus_four["bound"].max()),
    }
    return judge(bounds, AtMost(NEEDED.value, *bounds, says="largest proven distance"))


@claim(
    PLACE,
    "No output is further from its multiprecision reference than the proof allows.",
    (EIGHT, MINUS_FOUR),
    (
        Control("curves shifted by twice the bound at Omega = 8", {EIGHT: shifted}),
        Control("curves shifted by twice the bound at Omega = -4", {MINUS_FOUR: shifted}),
    ),
)
def references_within_bounds(eight, minus_four) -> Finding:
    """Ask it at every output; the reference has no part in the proof."""
    measured = {}
    for name, one in (("8", eight), ("minus_4", minus_four)):
        measured[f"least_margin_at_{name}"] = float(
            (one["bound"] - one["reference_distance"]).min()
        )
        measured[f"outputs_at_{name}"] = int(one["reference_distance"].notnull().sum())
    margins = [name for name in measured if name.startswith("least")]
    outputs = [name for name in measured if name.startswith("outputs")]
    criterion = AllOf(
        AtLeast(0.0, *margins, says="bound less the distance to the reference, at its least"),
        AtLeast(2, *outputs, says="outputs with a reference"),
    )
    return judge(measured, criterion)
