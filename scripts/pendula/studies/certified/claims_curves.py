"""What is proved of the curves of small initial conditions."""

from pendula.ledger.claim import Control, claim
from pendula.ledger.criterion import AtMost, Finding, judge
from pendula.ledger.cutoff import Cutoff

SECTION = 7
EIGHT, MINUS_FOUR, WRONG = "certified/fig2_small", "certified/fig3_small", "certified/wrong/curve"
NEEDED = Cutoff(1e-9, "1 % of the relative tolerance, 1e-7, of the paper's solver")


@claim(
    "Beyond the paper, Figs 2 and 3 upper",
    "The computed trajectories are proved to lie within 1e-9 of the true ones.",
    (EIGHT, MINUS_FOUR),
    (Control("a curve of (4) with a drive that is larger by 1e-6", {MINUS_FOUR: WRONG}),),
)
def curves_certified(eight, minus_four) -> Finding:
    """Read the bounds at the end of the runs."""
    bounds = {
        "bound_at_8": float(eight["bound"].max()),
        "bound_at_minus_4": float(minus_four["bound"].max()),
    }
    return judge(bounds, AtMost(NEEDED, *bounds, says="largest proven distance"))
