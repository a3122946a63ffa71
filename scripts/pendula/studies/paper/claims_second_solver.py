"""Section 5: the figures of the paper by its second solver.

Single runs of a chaotic case cannot agree for long. Where the motion is chaotic, a run of the
second solver is compared with the ensemble, as one more draw from it.
"""

from latticode.measures.confidence import chance_of_draw
from latticode.measures.difference import VISIBLE

from pendula.ledger import missing
from pendula.ledger.changes import put, repeat
from pendula.ledger.claim import FEWEST, Control, checks, claim, sweeps
from pendula.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff

SECTION = 5
SEEN = Cutoff(VISIBLE, "a reader sees a difference of 1 % of full scale, wider than a line")
SIGNIFICANT = Cutoff(0.05, '"significant": the level that is customary in statistics')
LEAST = 1e-6
"""The digits of a chance: no smaller one is told from zero."""
LATE, WINDOW = (30.0, 50.0), "[30, 50]"
"""The time over which a run is compared with its ensemble."""

FIRST = sweeps("fig5_left", "fig6_left")
SECOND = tuple(f"{name}.crank_nicolson" for name in FIRST)
RIGHT, COARSE = sweeps("fig6_right.crank_nicolson", "fig6_right.crank_nicolson_coarse")
"""The regular sweeps by either solver, and a chaotic one by the second with two steps."""


# --- Figs 2 to 4 ----------------------------------------------------------------------------------


def late_chance(solvers, members, case: str) -> float:
    """Return the chance that a draw is as far from the mean of its ensemble as the second solver.

    The number is the late mean of the l2 norm, after the solvers diverge.
    """
    run, since = solvers.sel(case=case), LATE[0]
    known = WINDOW in members["window"].values and run["second_divergence"][0] < since
    if not known or members.sizes["member"] < missing.FEWEST or run["tau"][-1] < LATE[1]:
        raise UndecidableError(f"there is no ensemble of {case} on {WINDOW}, or it is too small")
    drawn = members["l2_level"].sel(case=case, quantity="pair", window=WINDOW).values
    value = run["second_l2"].sel(tau=slice(*LATE)).values.mean()
    return float(chance_of_draw(value, drawn.mean(), drawn.std(ddof=1), len(drawn)))


@claim(
    "Section 5, end",
    "With the second solver Figs 2 to 4 show no significant differences.",
    checks("solvers", "lyapunov", "members"),
    controls=(
        Control(
            "Omega = -4 by the second solver for Omega = 0, in a chaotic case",
            {"solvers": repeat("case", "fig3_large", at="fig4_large", names="second_l2")},
        ),
        Control("chaotic cases required to agree as single runs", {"lyapunov": put("chaotic", 0)}),
    ),
)
def second_solver(solvers, lyapunov, members) -> Finding:
    chaos, cases = lyapunov["chaotic"], list(map(str, solvers["case"].values))
    if unknown := [case for case in cases if case not in chaos["case"].values]:
        raise UndecidableError(f"it is not known whether {', '.join(unknown)} is chaotic")
    drawn = [case for case in cases if chaos.sel(case=case)]
    steady = solvers["second_difference"].sel(case=[case for case in cases if case not in drawn])
    since = {case: float(solvers["second_divergence"].sel(case=case)[0]) for case in cases}
    chances = [late_chance(solvers, members, case) for case in drawn]
    measured = {
        "largest_regular": steady[:, 0].max() if steady.size else 0.0,
        "at_half_step": steady[:, 1].max() if steady.size else 0.0,
        **{f"divergence_{case}": time for case, time in since.items()},
        "chance": min([1.0, *(len(chances) * chance for chance in chances)]),  # Bonferroni's bound
    }
    criterion = AllOf(
        Below(SEEN, "at_half_step", says="difference of regular runs at half of the assumed step"),
        Above(
            SIGNIFICANT,
            "chance",
            says="probability of a chaotic run as far from the mean late l2 norm of its ensemble",
        ),
    )
    said = [
        f"{case} differs visibly from tau = {since[case]:.3g} on, by up to {whole:.2g} with the"
        f" assumed step and {half:.2g} with half of it"
        for case, (whole, half) in zip(map(str, steady["case"].values), steady.values, strict=True)
        if whole > SEEN.value
    ]
    if drawn:
        parted = ", ".join(f"{case} from tau = {since[case]:.3g} on" for case in drawn)
        said.append(f"chaotic cases become other members of the same ensembles: {parted}")
    return judge(measured, criterion, "; ".join(said))


# --- Figs 5 and 6 ---------------------------------------------------------------------------------


def largest_difference(first, second) -> float:
    """Return the largest relative difference of the pair's norms over all of a sweep."""
    if first.sizes["half_width"] < FEWEST:
        raise UndecidableError(f"the sweeps have fewer than {FEWEST} half-widths")
    return max(
        float(abs(second[norm] / first[norm] - 1.0).sel(quantity="pair").max())
        for norm in ("l2", "linf")
    )


def swept_chance(sweep, ensembles) -> float:
    """Return the chance that draws of Fig 6, right, are as far from the means as the maxima of l2.

    It is that of the most distant of all half-widths, by Bonferroni's bound.
    """
    if "fig6_right" not in ensembles["sweep"].values:
        raise UndecidableError("there is no ensemble of fig6_right")
    drawn = ensembles.sel(sweep="fig6_right", reading="text")
    drawn = drawn.dropna("half_width", subset=["l2_mean"])
    at = {"quantity": "pair", "statistic": "max", "half_width": drawn["half_width"]}
    values = sweep["l2"].sel(at).sel(window="[10, 70]").values
    about = drawn["l2_mean"].values, drawn["l2_deviation"].values, int(drawn["swept_members"])
    chances = chance_of_draw(values, *about)
    return float(min(1.0, chances.size * chances.min()))


@claim(
    "Section 5, end",
    "With the second solver Figs 5 and 6 show no significant differences.",
    (*FIRST, *SECOND, RIGHT, COARSE, *checks("ensembles")),
    controls=(
        Control(
            "the sweeps of the first solver, as those of the second",
            {
                **dict(zip(SECOND, FIRST, strict=True)),
                **dict.fromkeys((RIGHT, COARSE), "fig6_right"),
            },
            confirms=True,
        ),
        Control(
            "the sweep at Omega = -4 for that at Omega = 8 by the second solver",
            {SECOND[1]: "fig6_right"},
        ),
    ),
    on=("fig5_left", "fig6_left", "fig6_right"),
)
def second_solver_sweeps(left_5, left_6, second_5, second_6, right, coarse, ensembles) -> Finding:
    """Compare regular sweeps point by point, and a chaotic one with its ensemble, by two steps.

    Nothing is decided where the step does, for the paper gives none.
    """
    measured = {
        "fig5_left": largest_difference(left_5, second_5),
        "fig6_left": largest_difference(left_6, second_6),
        "chance": swept_chance(right, ensembles),
        "coarse_chance": swept_chance(coarse, ensembles),
    }
    regular = Below(SEEN, "fig5_left", "fig6_left", says="largest difference of a regular sweep")
    says = "probability of a sweep as far from the ensembles of Fig 6, right, by either step"
    alike = Above(SIGNIFICANT, "chance", "coarse_chance", says=says)
    if regular.holds(measured) and len(alike.failing(measured)) == 1:
        steps = [one.attrs["solver_step"] for one in (right, coarse)]
        because = (
            "the paper gives no step: in Fig 6, right, chance makes a sweep as far from the"
            f" ensembles with the probability {measured['chance']:.2g} for a step of {steps[0]:g},"
            f" and {max(LEAST, measured['coarse_chance']):.2g} for {steps[1]:g}"
        )
        return undecided(measured, because)
    return judge(measured, AllOf(regular, alike), "Fig 5, right, is not compared")
