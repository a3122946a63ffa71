"""Section 4: Lemma 2, the inequalities, Theorems 1 to 3, their proofs and how sharp they are."""

from pendula.ledger.changes import exchange, put, scale, take
from pendula.ledger.claim import Control, Kind, checks, claim, number
from pendula.ledger.criterion import Above, AllOf, AtLeast, AtMost, Finding, judge, undecided
from pendula.ledger.cutoff import Cutoff

from .claims_model import by_algebra

SECTION = 4

# ASSUME: what is said to grow with the chain, as C_N does in proportion to N, has an exponent of N
# nearer to one than to zero.
IN_PROPORTION = Cutoff(0.5, '"grows with N": the exponent of N is nearer to 1 than to 0')
SHARP = Cutoff(0.9, '"sharp": at least 90 % of the bound is reached', ideal=1.0)
ROUNDING_OF_H = Cutoff(-1e-12, "rounding of the energy")


@by_algebra(
    "Proof of Lemma 2, (16)",
    "Solutions exist locally, by Picard's method on the integral equations.",
    {name: f"{name} with 3/4 of the right side" for name in ("(17)", "(18)")},
    kind=Kind.THEOREM,
)
def local_existence():
    """Picard's method asks for Lipschitz rates: the linear ones are by (17), the cubic by (18)."""


APART = {"distance of two solutions": "a rate of half of the drive"}


@by_algebra("Lemma 2", "The solution is unique.", APART, kind=Kind.THEOREM)
def uniqueness():
    """The distance d of two solutions obeys d' <= (2 |gamma| + M^2 / 2) d: from none none comes.

    M is the largest amplitude on the straight way between both, along which the rates are
    integrated by their derivative, to which the identity belongs.
    """


@by_algebra(
    "Lemma 2",
    "The solution depends continuously on the initial data.",
    APART,
    kind=Kind.THEOREM,
)
def continuous_dependence():
    """The same rate bounds the distance at any later time by a multiple of the first one."""


@by_algebra(
    "Lemma 2, (19)",
    "The squared l2 norm grows at most as exp(4 |gamma tau|).",
    {"(19)": "the bound exp(2 |gamma tau|)"},
    kind=Kind.THEOREM,
)
def growth_bound():
    """The rate of P is at most 4 |gamma| P, in both directions of time."""


@by_algebra(
    "Proof of Lemma 2",
    "The l2 norm obeys the balance equation.",
    {"balance of P": "the balance equation with twice the drive"},
)
def balance():
    """The rate of P along the equations is that of the balance."""


@by_algebra(
    "Section 4, before Theorem 1",
    "It suffices to consider gamma > 0.",
    {"sign of gamma": "(A, B) -> (-A, -B) in place of (iA, iB)"},
)
def sign_of_gamma():
    """All amplitudes times i turn the sign of gamma."""


@by_algebra(
    "Section 4, (17), (18), (22) and (27)",
    "For sequences, the sum of |a_(n+1) - a_n|^2 is at most 4 times the squared l2 norm; the l2 "
    "norm of a product is at most the product of the l2 norms; the l4 norm is at most the l2 "
    "norm, which on N sites is at most N^(1/4) times the l4 norm.",
    {name: f"{name} with 3/4 of the right side" for name in ("(17)", "(18)", "(22)", "(27)")},
)
def norm_inequalities():
    """The right side less the left one is a sum of squares."""


HALF_OF_THE_DRIVE = "a bound of the energy with half of the drive"


@by_algebra(
    "Section 4, (21) and (25)",
    "If Omega > 2 gamma + 4 epsilon, H >= (Omega - 2 gamma - 4 epsilon) P. If Omega < -2 gamma,"
    " -H >= (|Omega| - 2 gamma) P - P^2 / 4. The energy of a sequence in l2 is finite, and of the"
    " order of P where P is small.",
    dict.fromkeys(("(21)", "(25)", "size of H"), HALF_OF_THE_DRIVE),
)
def energy_bounds():
    """H less its lower bound, and its upper bound less H, are sums of squares."""


CONSERVED = {"conservation of (8)": "the energy of another Omega"}


@by_algebra(
    "Theorem 1",
    "For Omega > 2 gamma + 4 epsilon the l2 norm is bounded for all initial conditions.",
    {**CONSERVED, "(21)": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def theorem_1():
    """H is conserved and by (21) at least a multiple of P."""


@by_algebra(
    "Theorem 2",
    "For Omega < -2 gamma the l2 norm is bounded for small initial conditions.",
    {**CONSERVED, "(25)": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def theorem_2():
    """By (25) no state of a small energy is on the barrier that P, being continuous, must pass."""


@by_algebra(
    "Proof of Theorem 2",
    "-H > 0 for small initial conditions.",
    {"(25)": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def positive_depth():
    """By (25) -H / P is at least a - P / 4 with a = |Omega| - 2 gamma > 0."""


@claim(
    "Proof of Theorem 2",
    "The lower bound (25) yields the upper bound (24).",
    checks("errata"),
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
    measured = {name: number(check, name) for name in ("largest_power", "allowed_power")}
    largest, allowed = measured.values()
    fails = (
        f"a state with P = {largest:.3g} satisfies (25) at an energy for which (24) allows only "
        f"{allowed:.3g}: the proof assumes the bound P <= C_0 delta that it is to prove; the "
        "theorem stands, because P is continuous in time and starts below the barrier"
    )
    says = "largest P that the proof's inequalities allow"
    return judge(measured, AtMost(allowed, "largest_power", says=says), fails=fails)


@by_algebra(
    "Theorem 3",
    "On N sites the l2 norm is bounded for all parameters and initial conditions.",
    {**CONSERVED, "lower bound for Theorem 3": HALF_OF_THE_DRIVE},
    kind=Kind.THEOREM,
)
def theorem_3():
    """H is conserved, and P^2 / (8 N) - c P is at most H, by the bound and (27)."""


@claim(
    "Proof of Theorem 3",
    "The quadratic part of H is at least -(|Omega| + gamma + 4 epsilon) P.",
    checks("errata"),
    controls=(Control("2 gamma in place of gamma", take(printed="corrected"), confirms=True),),
    kind=Kind.THEOREM,
)
def theorem_3_proof(check) -> Finding:
    measured = {name: check[name].min() for name in ("printed", "corrected")}
    measured["smallest_chain"] = smallest = number(check, "smallest")
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
    """Ask that C_N grows, and that the largest P of data of one energy does."""
    measured = {
        name: number(check, name, omega=0.0) for name in ("constant_exponent", "shell_exponent")
    }
    caveat = "it must at Omega = 0; above the band Theorem 1 gives one bound for all N"
    criterion = AllOf(
        Above(IN_PROPORTION, "constant_exponent", says="exponent of N in C_N"),
        Above(IN_PROPORTION, "shell_exponent", says="exponent of N in the largest P of one energy"),
    )
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, before Fig 4",
    "At Omega = 0 the energy does not control large solutions.",
    checks("chain_growth"),
    controls=(Control("Omega = 8, where the energy bounds P", ABOVE_THE_BAND),),
)
def energy_not_useful(check) -> Finding:
    measured = {"shell_exponent": number(check, "shell_exponent", omega=0.0)}
    says = "exponent of N in the largest P of one energy"
    return judge(measured, Above(IN_PROPORTION, "shell_exponent", says=says))


@claim(
    "Section 6; Theorems 1 to 3",
    "The bounds of Theorems 1, 2 and 3 in terms of the initial energy are sharp.",
    checks("sharpness"),
    controls=(Control("bounds 25 % too large", scale("reached", 0.8)),),
)
def sharp_theorems(check) -> Finding:
    measured = {str(form): float(check["reached"].sel(form=form)) for form in check["form"].values}
    how = (
        "in the limit of long chains: the bounds of Theorems 1 and 2 are reached by a tiny wave at "
        "the edge of the band, that of Theorem 3 at Omega = -4 by A = -B = x (-1)^n"
    )
    return judge(measured, Above(SHARP, *measured, says="share of each bound that is reached"), how)


@claim(
    "Section 6; Theorem 2, (24)",
    "The bound C_0 delta of Theorem 2 is sharp.",
    checks("sharpness"),
    controls=(
        Control(
            "the least C_0 in place of the proof's",
            take(limit_constant="least_constant"),
            confirms=True,
        ),
        Control("initial conditions of which no P grows", put("least_constant", 1.0)),
    ),
)
def sharp_theorem_2_ball(check) -> Finding:
    """The paper gives no C_0: it may be the least one, or that of the inequality in its proof."""
    limit, least = (number(check, name) for name in ("limit_constant", "least_constant"))
    share = least / limit
    measured = {"limit_constant": limit, "least_constant": least, "share": share}
    sharp = AllOf(
        Above(1.0, "least_constant", says="growth of P"),
        Above(SHARP, "share", says="share of the bound that is reached"),
    )
    if sharp.failing(measured) == ["share"]:
        return undecided(
            measured,
            f"the paper gives no C_0: its inequality gives C_0 = {limit:.3g} as delta goes to 0, "
            f"of which {share:.0%} is reached, and C_0 = {least:.3g} is enough",
        )
    return judge(measured, sharp)
