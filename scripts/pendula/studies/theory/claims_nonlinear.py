"""Section 4: Lemma 2, the inequalities, Theorems 1 to 3 and their proofs."""

from collections.abc import Callable

import numpy as np
from latticode.numerics.elementary import log

from pendula.ledger.changes import exchange, scale, take
from pendula.ledger.claim import LARGE, SMALL, Control, Kind, checks, claim, number
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    judge,
    within_tolerance,
)
from pendula.ledger.cutoff import Cutoff
from pendula.models.bounds import growth_margin

from .claims_model import IDENTITIES, NEAR, proved, twin

SECTION = 4

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
    controls=(Control("a longer interval", take(contraction="long_contraction")),),
    kind=Kind.THEOREM,
)
def local_existence(check) -> Finding:
    return within_tolerance(check, "contraction", "picard_error")


@claim(
    "Lemma 2",
    "The solution is unique.",
    checks("picard"),
    controls=(
        Control("an added term A / |A|^(1/2), from rest", take(limits_apart="rooted_limits_apart")),
    ),
    kind=Kind.THEOREM,
)
def uniqueness(check) -> Finding:
    """Iterates from two first guesses must have one limit; time in steps continues that."""
    return within_tolerance(check, "limits_apart")


def as_far_apart(check):
    """Return the check with ends that are as far apart for all distances of the data."""
    apart = check["distance"].max() / check["distance"]
    return scale("stretch", apart)(check)


@claim(
    "Lemma 2",
    "The solution depends continuously on the initial data.",
    checks("dependence"),
    controls=(Control("ends that stay apart as the initial data approach", as_far_apart),),
    kind=Kind.THEOREM,
)
def continuous_dependence(check) -> Finding:
    near, nearer = (check.isel(distance=i) for i in (-2, -1))
    steps = log(float(near["distance"] / nearer["distance"]))
    orders = 1.0 + log(near["stretch"].values / nearer["stretch"].values) / steps
    measured = {
        "least_order": orders.min(),
        "largest_order": orders.max(),
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
    (*IDENTITIES, *SMALL, *LARGE),
    (twin("(19)", "the bound exp(2 |gamma tau|)"),),
    kind=Kind.THEOREM,
)
def growth_bound(identities, *trajectories) -> Finding:
    """The rate of P is at most 4 |gamma| P, by algebra; so are slopes of log P in all cases."""
    margins = [
        growth_margin(ds["tau"].values, ds["l2"].values, ds.attrs["gamma"]) for ds in trajectories
    ]
    finding = proved(identities, "(19)")
    measured = {**finding.measured, "steepest": max(one["steepest"] for one in margins)}
    slope = AtMost(ROUNDING, "steepest", says="slope of log P over 4 gamma")
    return judge(measured, AllOf(finding.criterion, slope))


@claim(
    "Proof of Lemma 2",
    "The l2 norm obeys the balance equation.",
    IDENTITIES,
    controls=(twin("balance of P", "the balance equation with twice the drive"),),
    kind=Kind.IDENTITY,
)
def balance(identities) -> Finding:
    return proved(identities, "balance of P")


@claim(
    "Section 4, before Theorem 1",
    "It suffices to consider gamma > 0.",
    IDENTITIES,
    controls=(twin("sign of gamma", "(A, B) -> (-A, -B) in place of (iA, iB)"),),
    kind=Kind.IDENTITY,
)
def sign_of_gamma(identities) -> Finding:
    return proved(identities, "sign of gamma")


OF_SEQUENCES, OF_ENERGIES = ("(17)", "(18)", "(22)", "(27)"), ("(21)", "(25)", "size of H")


@claim(
    "Section 4, (17), (18), (22) and (27)",
    "For sequences, the sum of |a_(n+1) - a_n|^2 is at most 4 times the squared l2 norm; the l2 "
    "norm of a product is at most the product of the l2 norms; the l4 norm is at most the l2 "
    "norm, which on N sites is at most N^(1/4) times the l4 norm.",
    IDENTITIES,
    controls=tuple(twin(name, f"{name} with 3/4 of the right side") for name in OF_SEQUENCES),
    kind=Kind.IDENTITY,
)
def norm_inequalities(identities) -> Finding:
    """The right side less the left one is a sum of squares."""
    return proved(identities, *OF_SEQUENCES)


@claim(
    "Section 4, (21) and (25)",
    "If Omega > 2 gamma + 4 epsilon, H >= (Omega - 2 gamma - 4 epsilon) P. If Omega < -2 gamma,"
    " -H >= (|Omega| - 2 gamma) P - P^2 / 4. The energy of a sequence in l2 is finite, and of the"
    " order of P where P is small.",
    IDENTITIES,
    controls=tuple(twin(name, f"{name} with half of the drive") for name in OF_ENERGIES),
    kind=Kind.IDENTITY,
)
def energy_bounds(identities) -> Finding:
    """H less its lower bound, and its upper bound less H, are sums of squares."""
    return proved(identities, *OF_ENERGIES)


def theorem(name: str, says: str, bound: str, *families: str) -> Callable:
    """Return the function that decides a theorem: its `bound` of the energy, and random data."""

    def decide(identities, samples) -> Finding:
        finding = proved(identities, "conservation of (8)", bound)
        sampled = samples["worst_sample"].sel(family=list(families)).max()
        within = AtMost(ROUNDING, "worst_sample", says="largest P over its bound")
        measured = {**finding.measured, "worst_sample": sampled}
        return judge(measured, AllOf(finding.criterion, within))

    decide.__name__ = name
    controls = (
        twin(bound, "a lower bound of the energy with half of the drive"),
        Control("bounds without the drive", {"samples": take(worst_sample="worst_without_drive")}),
    )
    place, needs = name.replace("_", " ").capitalize(), checks("identities", "samples")
    return claim(place, says, needs, controls, kind=Kind.THEOREM)(decide)


theorem_1 = theorem(
    "theorem_1",
    "For Omega > 2 gamma + 4 epsilon the l2 norm is bounded for all initial conditions.",
    *("(21)", "theorem_1"),
)

theorem_2 = theorem(
    "theorem_2",
    "For Omega < -2 gamma the l2 norm is bounded for small initial conditions.",
    *("(25)", "theorem_2_ball", "theorem_2_energy", "theorem_2_widened"),
)


@claim(
    "Proof of Theorem 2",
    "-H > 0 for small initial conditions.",
    checks("identities", "theorem_2_case"),
    controls=(
        Control("initial P 100 times as large", {"theorem_2_case": scale("delta_0", 100.0)}),
        twin("(25)", "(25) with half of the drive"),
    ),
    kind=Kind.THEOREM,
)
def positive_depth(identities, case) -> Finding:
    """By (25) -H / P is at least a - P / 4; the barrier is the square of a = |Omega| - 2 gamma."""
    finding, radius = proved(identities, "(25)"), number(case, "delta_0")
    least = np.sqrt(number(case, "barrier")) - 0.25 * radius
    measured = {**finding.measured, "least_depth": least, "radius": radius}
    deep = Above(0.0, "least_depth", says="least -H / P within the radius by (25)")
    return judge(measured, AllOf(finding.criterion, deep))


@claim(
    "Proof of Theorem 2",
    "The lower bound (25) yields the upper bound (24).",
    checks("bootstrap"),
    controls=(
        Control(
            "only states below the barrier, which continuity in time ensures",
            take(largest_power="largest_power_below"),
            confirms=True,
        ),
    ),
    kind=Kind.THEOREM,
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
    *("lower bound for Theorem 3", "theorem_3"),
)


@claim(
    "Proof of Theorem 3",
    "The quadratic part of H is at least -(|Omega| + gamma + 4 epsilon) P.",
    checks("theorem_3_constant"),
    controls=(Control("2 gamma in place of gamma", take(printed="corrected"), confirms=True),),
    kind=Kind.THEOREM,
)
def theorem_3_proof(constant) -> Finding:
    measured = {name: constant[name].min() for name in ("printed", "corrected")}
    measured["smallest_chain"] = smallest = number(constant, "smallest")
    fails = (
        f"A = -B = x (-1)^n violates it on {smallest:.0f} sites and more; with 2 gamma in place of "
        "gamma it holds"
    )
    return judge(measured, AtLeast(ROUNDING_OF_H, "printed", says="H minus the bound"), fails=fails)


ABOVE_THE_BAND = exchange("omega", 0.0, 8.0)


@claim(
    "Theorem 3",
    "The bound C_N grows without bound with N, and must do so.",
    checks("chain_growth"),
    controls=(Control("Omega = 8, where Theorem 1 bounds P on any chain", ABOVE_THE_BAND),),
)
def bound_grows(check) -> Finding:
    within = check.sel(omega=0.0)
    names = ("constant_exponent", "power_exponent", "power_exponent_low", "power_exponent_high")
    measured = {name: number(within, name) for name in names}
    over = within["late_power"].mean("member") / within["constant_n"]
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
    controls=(Control("Omega = 8, where the energy bounds P", ABOVE_THE_BAND),),
)
def energy_not_useful(check) -> Finding:
    names = ("shell_exponent", "least_quotient", "largest_quotient")
    measured = {name: number(check, name, omega=0.0) for name in names}
    criterion = AllOf(
        Above(IN_PROPORTION, "shell_exponent", says="exponent of N in the largest P of one energy"),
        Below(0.0, "least_quotient", says="least H / P of tiny initial conditions"),
        Above(0.0, "largest_quotient", says="largest H / P of tiny initial conditions"),
    )
    return judge(measured, criterion)
