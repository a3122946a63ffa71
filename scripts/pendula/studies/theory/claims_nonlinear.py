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
IN_PROPORTION = Cutoff(0.5, '"grows with N": nearer to proportion than to a constant')
ROUNDING = Cutoff(1.0 + 1e-6, "solvers and rounding may exceed a bound that is reached", 1.0)
ROUNDING_OF_H = Cutoff(-1e-12, "rounding of the energy")


@claim(
    "Proof of Lemma 2, (16)",
    "Solutions exist locally, by Picard's method on the integral equations.",
    checks("picard"),
    controls=(Control("an interval forty times as long", "checks/wrong/picard"),),
)
def local_existence(check) -> Finding:
    names = (f"{name}_{way}" for name in ("contraction", "picard_error") for way in WAYS)
    return within_tolerance(check, *names)


@claim(
    "Lemma 2",
    "The solution is unique.",
    checks("picard"),
    controls=(Control("rates A / |A|^(1/2) besides, from rest", "checks/wrong/picard_at_rest"),),
)
def uniqueness(check) -> Finding:
    """Iterates from two first guesses must have one limit; time in steps continues that."""
    return within_tolerance(check, *(f"limits_apart_{way}" for way in WAYS))


@claim(
    "Lemma 2",
    "The solution depends continuously on initial data.",
    checks("dependence"),
    controls=(Control("two solutions with an Omega of their own", "checks/wrong/dependence"),),
)
def continuous_dependence(check) -> Finding:
    measured = {
        "least_order": check["distance_order"].min(),
        "largest_order": check["distance_order"].max(),
        "largest_stretch": check["stretch"].max(),
        "over_gronwall": check["stretch_over_bound"].max(),
    }
    says = "order of the distance at the end in that of the data"
    criterion = AllOf(
        Near(FIRST, NEAR, "least_order", "largest_order", says=says),
        AtMost(1.0, "over_gronwall", says="the distance over Gronwall's bound"),
    )
    return judge(measured, criterion)


@claim(
    "Lemma 2, (19)",
    "The squared l2 norm grows at most as exp(4 |gamma tau|).",
    (*checks("growth"), *SMALL, *LARGE),
    (Control("a bound exp(2 |gamma tau|)", {"growth": "checks/wrong/growth"}),),
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
    controls=(Control("the balance of half of the drive", "checks/wrong/balance"),),
)
def balance(check) -> Finding:
    return within_tolerance(check, "pointwise", "integrated")


@claim(
    "Section 4, before Theorem 1",
    "It suffices to look at gamma > 0.",
    checks("conservation"),
    controls=(Control("(A, B) -> (-A, -B) for (iA, iB)", "checks/wrong/phase_turned"),),
)
def sign_of_gamma(conservation) -> Finding:
    return within_tolerance(conservation, "sign_defect")


@claim(
    "Section 4, (17), (18), (22) and (27)",
    "The bonds of a sequence are at most four times its l2 norm squared, the l2 norm of a product"
    " is at most the product of the l2 norms, the l4 norm is at most the l2 norm, and this is at"
    " most N^(1/4) times the l4 norm on N sites.",
    checks("inequalities"),
    controls=(Control("three quarters of the right sides", "checks/wrong/inequalities"),),
)
def norm_inequalities(check) -> Finding:
    """Take the largest left side over its right side, in tries and in data that make it equal."""
    numbers = [str(label) for label in check["inequality"].values]
    measured = {f"ratio_{n}": check["left_over_right"].sel(inequality=n) for n in numbers}
    sharp = {f"sharpest_{n}": check["sharp"].sel(inequality=n) for n in numbers}
    return judge(measured | sharp, AtMost(ROUNDING, *measured, says="left side over right side"))


@claim(
    "Section 4, (21) and (25)",
    "For Omega > 2 gamma + 4 epsilon H is at least (Omega - 2 gamma - 4 epsilon) P, for"
    " Omega < -2 gamma -H is at least (|Omega| - 2 gamma) P - P^2 / 4, and the energy of data in l2"
    " is finite, of the order of P where P is small.",
    checks("inequalities"),
    controls=(Control("bounds with half of the drive", "checks/wrong/inequalities"),),
)
def energy_bounds(check) -> Finding:
    excess, limit = check["bound_excess"], tolerance(check, "bound_excess")
    measured = {f"excess_{bound}": excess.sel(bound=bound) for bound in ("(21)", "(25)", "size")}
    return judge(measured, AtMost(limit, *measured, says="bound minus energy, over P"))


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
    place, forgets = name.replace("_", " ").capitalize(), "bounds that forget the drive"
    control = Control(forgets, {"samples": "checks/wrong/samples", "worst": "checks/wrong/worst"})
    return claim(place, says, checks("samples", "worst"), (control,), reading=reading)(decide)


theorem_1 = theorem(
    "theorem_1", "For Omega > 2 gamma + 4 epsilon the l2 norm is bounded for all data.", "theorem_1"
)

theorem_2 = theorem(
    "theorem_2",
    "For Omega < -2 gamma the l2 norm is bounded for small data.",
    *("theorem_2_ball", "theorem_2_energy", "theorem_2_widened"),
)


@claim(
    "Proof of Theorem 2",
    "-H > 0 for small data.",
    checks("negative_depth"),
    controls=(Control("data a hundred times as large", "checks/wrong/negative_depth"),),
)
def positive_depth(depth) -> Finding:
    radius = number(depth, "largest_start")
    measured = {"largest_energy": number(depth, "most_energy"), "radius": radius}
    return judge(measured, Below(0.0, "largest_energy", says="largest H / P of data in the ball"))


@claim(
    "Proof of Theorem 2",
    "The lower bound (25) yields the upper bound (24).",
    checks("bootstrap"),
    controls=(
        Control(
            "states below the barrier, as continuity gives", "checks/wrong/bootstrap", confirms=True
        ),
    ),
)
def bootstrap(check) -> Finding:
    names = ("largest_power", "allowed_power", "breaking")
    measured = {name: number(check, name) for name in names}
    _, allowed, breaking = measured.values()
    fails = (
        f"a pair with P = {breaking:.3g} satisfies (25) and has the energy of data for"
        f" which (24) allows {allowed:.3g}: the proof assumes P <= C_0 delta,"
        " which it is to prove; the theorem stands, as P is continuous and starts below the barrier"
    )
    criterion = AtMost(allowed, "largest_power", says="largest P that the premises allow")
    return judge(measured, criterion, fails=fails)


theorem_3 = theorem(
    "theorem_3",
    "On N sites the l2 norm is bounded for all parameters and data.",
    "theorem_3",
    reading="random and worst data",
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
    fails = f"A = -B = x (-1)^n breaks it from {smallest:.0f} sites on; it needs 2 gamma"
    return judge(measured, AtLeast(ROUNDING_OF_H, "printed", says="H - bound"), fails=fails)


@claim(
    "Theorem 3",
    "The bound C_N grows without end as N does, and has to.",
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
    caveat = (
        "has to at Omega = 0; for Omega > 2 gamma + 4 epsilon Theorem 1 has one bound for all N"
    )
    criterion = AllOf(
        Above(IN_PROPORTION, "constant_exponent", says="exponent of C_N in N"),
        Above(IN_PROPORTION, "power_exponent_low", says="least exponent of the late mean of P"),
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
        Above(IN_PROPORTION, "shell_exponent", says="exponent of the largest P of one energy in N"),
        Below(0.0, "least_quotient", says="least H / P of tiny data"),
        Above(0.0, "largest_quotient", says="their largest H / P"),
    )
    return judge(measured, criterion)
