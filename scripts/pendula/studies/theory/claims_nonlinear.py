"""Section 4: Lemma 2, the inequalities, Theorems 1 to 3 and their proofs."""

from collections.abc import Callable

import numpy as np

from pendula.ledger.changes import take
from pendula.ledger.claim import LARGE, SMALL, Control, checks, claim, number
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    judge,
    tolerance,
    within_tolerance,
)
from pendula.ledger.cutoff import Cutoff
from pendula.measures.norms import growth_margin

from .claims_model import NEAR

SECTION = 4

WAYS = ("forwards", "backwards")
FIRST = 1.0
"""The order of the distance of two solutions in that of their data."""
# ASSUME: what is said to grow with the chain, as C_N does in proportion to N, has an exponent of N
# nearer to one than to zero.
IN_PROPORTION = Cutoff(0.5, '"grows with N": the exponent of N is nearer to 1 than to 0')
ROUNDING = Cutoff(1.0 + 1e-6, "solver errors and rounding may exceed a bound that is attained", 1.0)
ROUNDING_OF_H = Cutoff(-1e-12, "rounding of the energy")


@claim(
    "Proof of Lemma 2, (16)",
    "Solutions exist locally, by Picard's method on the integral equations.",
    checks("picard"),
    controls=(Control("an interval 40 times as long", "checks/wrong/picard"),),
)
def local_existence(check) -> Finding:
    names = (f"{name}_{way}" for name in ("contraction", "picard_error") for way in WAYS)
    return within_tolerance(check, *names)


@claim(
    "Lemma 2",
    "The solution is unique.",
    checks("picard"),
    controls=(Control("an added term A / |A|^(1/2), from rest", "checks/wrong/picard_at_rest"),),
)
def uniqueness(check) -> Finding:
    """Iterates from two first guesses must have one limit; time in steps continues that."""
    return within_tolerance(check, *(f"limits_apart_{way}" for way in WAYS))


@claim(
    "Lemma 2",
    "The solution depends continuously on the initial data.",
    checks("dependence"),
    controls=(Control("two solutions at different Omega", "checks/wrong/dependence"),),
)
def continuous_dependence(check) -> Finding:
    measured = {
        "least_order": check["distance_order"].min(),
        "largest_order": check["distance_order"].max(),
        "largest_stretch": check["stretch"].max(),
        "over_gronwall": check["stretch_over_bound"].max(),
    }
    says = "order of the final distance in the initial distance"
    criterion = AllOf(
        Near(FIRST, NEAR, "least_order", "largest_order", says=says),
        AtMost(1.0, "over_gronwall", says="final distance over Gronwall's bound"),
    )
    return judge(measured, criterion)


@claim(
    "Lemma 2, (19)",
    "The squared l2 norm grows at most as exp(4 |gamma tau|).",
    (*checks("growth"), *SMALL, *LARGE),
    (Control("the bound exp(2 |gamma tau|)", {"growth": "checks/wrong/growth"}),),
)
def growth_bound(check, *trajectories) -> Finding:
    steepest = [
        growth_margin(ds["tau"].values, ds["l2"].values, ds.attrs["gamma"])["steepest"]
        for ds in trajectories
    ]
    measured = {
        "steepest": max(steepest),
        "random_data": check["steepest"].max(),
        "sharp_case": number(check, "sharpest"),
    }
    says = "slope of log P over 4 gamma"
    return judge(measured, AtMost(ROUNDING, "steepest", "random_data", says=says))


@claim(
    "Proof of Lemma 2",
    "The l2 norm obeys the balance equation.",
    checks("balance"),
    controls=(Control("the balance equation with half of the drive", "checks/wrong/balance"),),
)
def balance(check) -> Finding:
    return within_tolerance(check, "pointwise", "integrated")


@claim(
    "Section 4, before Theorem 1",
    "It suffices to consider gamma > 0.",
    checks("conservation"),
    controls=(Control("(A, B) -> (-A, -B) in place of (iA, iB)", "checks/wrong/phase_turned"),),
)
def sign_of_gamma(conservation) -> Finding:
    return within_tolerance(conservation, "sign_defect")


@claim(
    "Section 4, (17), (18), (22) and (27)",
    "For sequences, the sum of |a_(n+1) - a_n|^2 is at most 4 times the squared l2 norm; the l2 "
    "norm of a product is at most the product of the l2 norms; the l4 norm is at most the l2 "
    "norm, which on N sites is at most N^(1/4) times the l4 norm.",
    checks("inequalities"),
    controls=(Control("the right sides times 3/4", "checks/wrong/inequalities"),),
)
def norm_inequalities(check) -> Finding:
    """Take the largest left side over its right side, in tries and in data that make it equal."""
    numbers = [str(label) for label in check["inequality"].values]
    measured = {f"ratio_{n}": check["left_over_right"].sel(inequality=n) for n in numbers}
    sharp = {f"sharpest_{n}": check["sharp"].sel(inequality=n) for n in numbers}
    return judge(measured | sharp, AtMost(ROUNDING, *measured, says="left side over right side"))


@claim(
    "Section 4, (21) and (25)",
    "If Omega > 2 gamma + 4 epsilon, H >= (Omega - 2 gamma - 4 epsilon) P. If Omega < -2 gamma,"
    " -H >= (|Omega| - 2 gamma) P - P^2 / 4. The energy of a sequence in l2 is finite, and of the"
    " order of P where P is small.",
    checks("inequalities"),
    controls=(Control("bounds with half of the drive", "checks/wrong/inequalities"),),
)
def energy_bounds(check) -> Finding:
    excess, limit = check["bound_excess"], tolerance(check, "bound_excess")
    measured = {f"excess_{bound}": excess.sel(bound=bound) for bound in ("(21)", "(25)", "size")}
    return judge(measured, AtMost(limit, *measured, says="excess of the bound over H, over P"))


def theorem(name: str, says: str, *families: str, reading: str = "") -> Callable:
    """Return the function that decides a theorem: no random or searched data break its bounds."""

    def decide(samples, worst) -> Finding:
        sampled = samples["worst_sample"].sel(family=list(families))
        searched = worst["worst"].values[np.isin(worst["searched_family"].values, families)]
        measured = {"worst_sample": sampled.max(), "worst_searched": searched.max()}
        if "theorem_3" in families:
            measured["ring_of_two"] = number(worst, "attained")
        says = "largest P over its bound"
        return judge(measured, AtMost(ROUNDING, *measured, says=says))

    decide.__name__ = name
    place, forgets = name.replace("_", " ").capitalize(), "bounds without the drive"
    control = Control(forgets, {"samples": "checks/wrong/samples", "worst": "checks/wrong/worst"})
    return claim(place, says, checks("samples", "worst"), (control,), reading=reading)(decide)


theorem_1 = theorem(
    "theorem_1",
    "For Omega > 2 gamma + 4 epsilon the l2 norm is bounded for all initial conditions.",
    "theorem_1",
)

theorem_2 = theorem(
    "theorem_2",
    "For Omega < -2 gamma the l2 norm is bounded for small initial conditions.",
    *("theorem_2_ball", "theorem_2_energy", "theorem_2_widened"),
)


@claim(
    "Proof of Theorem 2",
    "-H > 0 for small initial conditions.",
    checks("negative_depth"),
    controls=(Control("initial conditions 100 times as large", "checks/wrong/negative_depth"),),
)
def positive_depth(depth) -> Finding:
    radius = number(depth, "largest_start")
    measured = {"largest_energy": number(depth, "most_energy"), "radius": radius}
    return judge(measured, Below(0.0, "largest_energy", says="largest H / P within the radius"))


@claim(
    "Proof of Theorem 2",
    "The lower bound (25) yields the upper bound (24).",
    checks("bootstrap"),
    controls=(
        Control(
            "only states below the barrier, which continuity in time ensures",
            "checks/wrong/bootstrap",
            confirms=True,
        ),
    ),
)
def bootstrap(check) -> Finding:
    names = ("largest_power", "allowed_power", "breaking")
    measured = {name: number(check, name) for name in names}
    _, allowed, breaking = measured.values()
    fails = (
        f"a state with P = {breaking:.3g} satisfies (25) at an energy for which (24) allows only "
        f"{allowed:.3g}: the proof assumes the bound P <= C_0 delta that it is to prove; the "
        "theorem stands, because P is continuous in time and starts below the barrier"
    )
    criterion = AtMost(
        allowed, "largest_power", says="largest P that the proof's inequalities allow"
    )
    return judge(measured, criterion, fails=fails)


theorem_3 = theorem(
    "theorem_3",
    "On N sites the l2 norm is bounded for all parameters and initial conditions.",
    "theorem_3",
    reading="random and worst cases",
)


@claim(
    "Proof of Theorem 3",
    "The quadratic part of H is at least -(|Omega| + gamma + 4 epsilon) P.",
    checks("theorem_3_constant"),
    controls=(Control("2 gamma in place of gamma", take(printed="corrected"), confirms=True),),
)
def theorem_3_proof(constant) -> Finding:
    measured = {name: constant[name].min() for name in ("printed", "corrected")}
    measured["smallest_chain"] = smallest = number(constant, "smallest")
    fails = (
        f"A = -B = x (-1)^n violates it on {smallest:.0f} sites and more; with 2 gamma in place of "
        "gamma it holds"
    )
    return judge(measured, AtLeast(ROUNDING_OF_H, "printed", says="H less the bound"), fails=fails)


@claim(
    "Theorem 3",
    "The bound C_N grows without bound with N, and must do so.",
    checks("chain_growth"),
    controls=(
        Control("Omega = 8, where Theorem 1 bounds P on any chain", "checks/wrong/chain_growth"),
    ),
)
def bound_grows(check) -> Finding:
    names = ("constant_exponent", "power_exponent", "power_exponent_low", "power_exponent_high")
    measured = {name: number(check, name) for name in names}
    over = check["late_power"].mean("member") / check["constant_n"]
    measured["part_of_the_bound"] = over.values[-1]
    caveat = "it must at Omega = 0; above the band Theorem 1 gives one bound for all N"
    criterion = AllOf(
        Above(IN_PROPORTION, "constant_exponent", says="exponent of N in C_N"),
        Above(IN_PROPORTION, "power_exponent_low", says="lower confidence limit of that in P"),
    )
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, before Fig 4",
    "At Omega = 0 the energy does not control large solutions.",
    checks("energy_shell"),
    controls=(Control("Omega = 8, where the energy bounds P", "checks/wrong/energy_shell"),),
)
def energy_not_useful(check) -> Finding:
    names = ("shell_exponent", "least_quotient", "largest_quotient")
    measured = {name: number(check, name) for name in names}
    criterion = AllOf(
        Above(IN_PROPORTION, "shell_exponent", says="exponent of N in the largest P of one energy"),
        Below(0.0, "least_quotient", says="least H / P of tiny initial conditions"),
        Above(0.0, "largest_quotient", says="largest H / P of tiny initial conditions"),
    )
    return judge(measured, criterion)
