"""What is proved of the curves of small data, and whether the proof notices what is wrong."""

from pendula.ledger.claim import Control, claim, runs, wrong_run
from pendula.ledger.criterion import AllOf, AtLeast, AtMost, Finding, judge
from pendula.ledger.cutoff import Cutoff
from pendula.measures.difference import NORMS

from .lines import distance, half_lines

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


def raised(run):
    """Return a run whose curves lie the width of a printed line above where they are."""
    width = 2.0 * half_lines(run)
    return run.assign({name: run[name] + width.sel(norm=name, drop=True) for name in NORMS})


def _in_lines(run, proved) -> float:
    return float((distance(run, proved) / half_lines(run)).max())


@claim(
    PLACE,
    "At every output the printed lines contain the true curves, as a theorem.",
    (*runs("fig2_small", "fig3_small"), EIGHT, MINUS_FOUR),
    (
        wrong_run("the lines of Fig 3 in Fig 2", fig2_small="fig3_small"),
        wrong_run("the lines of Fig 2 in Fig 3", fig3_small="fig2_small"),
        wrong_run("lines that lie their own width too high", fig3_small=raised),
    ),
)
def lines_contain_curves(drawn_eight, drawn_minus_four, eight, minus_four) -> Finding:
    """Take the largest proven distance in units of half of a line; one or less is inside."""
    measured = {
        "at_8": _in_lines(drawn_eight, eight),
        "at_minus_4": _in_lines(drawn_minus_four, minus_four),
    }
    return judge(measured, AtMost(1.0, *measured, says="largest distance in halves of a line"))
