"""What is proved of the curves of small initial conditions."""

from pendula.ledger.claim import Control, claim, runs
from pendula.ledger.criterion import AllOf, AtMost, Finding, judge
from pendula.ledger.cutoff import Cutoff, once
from pendula.measures.difference import NORMS

from .lines import distance, half_lines

SECTION = 7
EIGHT, MINUS_FOUR, WRONG = "certified/fig2_small", "certified/fig3_small", "certified/wrong/curve"
NEEDED = Cutoff(1e-9, "1 % of the relative tolerance, 1e-7, of the paper's solver")


def raised(run):
    """Return a run whose curves lie the width of a printed line above where they are."""
    width = 2.0 * half_lines(run)
    return run.assign({name: run[name] + width.sel(norm=name, drop=True) for name in NORMS})


@once
def _in_lines(run, proved) -> float:
    return float((distance(run, proved) / half_lines(run)).max())


@claim(
    "Beyond the paper, Figs 2 and 3 upper",
    "The computed curves are proved to lie within 1 % of the solver's tolerance of the true ones, "
    "and at every output the printed lines contain the true curves.",
    (*runs("fig2_small", "fig3_small"), EIGHT, MINUS_FOUR),
    (
        Control("a curve of (4) with a drive that is larger by 1e-6", {MINUS_FOUR: WRONG}),
        Control("the lines of Fig 3 in Fig 2", {"trajectories/fig2_small": "fig3_small"}),
        Control("the lines of Fig 2 in Fig 3", {"trajectories/fig3_small": "fig2_small"}),
        Control("lines that are too high by their width", {"trajectories/fig3_small": raised}),
    ),
)
def curves_certified(drawn_eight, drawn_minus_four, eight, minus_four) -> Finding:
    """Read the bounds at the end of the runs, and distances in units of half of a line."""
    bounds = {
        "bound_at_8": float(eight["bound"].max()),
        "bound_at_minus_4": float(minus_four["bound"].max()),
    }
    in_lines = {
        "in_lines_at_8": _in_lines(drawn_eight, eight),
        "in_lines_at_minus_4": _in_lines(drawn_minus_four, minus_four),
    }
    criterion = AllOf(
        AtMost(NEEDED, *bounds, says="largest proven distance"),
        AtMost(1.0, *in_lines, says="largest distance in units of half of a line's width"),
    )
    return judge(bounds | in_lines, criterion)
