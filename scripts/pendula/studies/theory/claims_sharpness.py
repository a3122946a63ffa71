"""Section 6: how sharp the bounds on the l2 norms are, theorem by theorem and form by form.

A bound in terms of the energy is one thing, a constant times the size of the data another: the
paper has both, and says "sharp" of all.
"""

from pendula.ledger.claim import number
from pendula.ledger.criterion import Above, Finding, judge
from pendula.ledger.cutoff import Cutoff

from .deciding import changed, decides, wrong

SECTION = 6

SHARP = Cutoff(0.9, '"sharp": all but a tenth of the bound is reached', ideal=1.0)
LOOSE = (wrong("bounds a quarter too large", "sharpness"),)
TINY = "by tiny data in the wave at the edge of the band"


def on_chains(check, form: str) -> dict[str, float]:
    """Return what part of a bound is reached on the shortest and on the longest chain."""
    ratios = check["reached"].sel(form=form)
    shortest, longest = (int(n) for n in ratios["sites"].values[[0, -1]])
    return {f"on_{shortest}_sites": ratios[0], f"on_{longest}_sites": ratios[-1]}


def judge_sharpness(check, form: str, how: str, fails: str = "") -> Finding:
    """Return the finding on a form: what the longest chain reaches decides."""
    measured = on_chains(check, form)
    longest = list(measured)[-1]
    says = f"part of the bound that is reached {longest.replace('_', ' ')}"
    criterion = Above(SHARP, longest, says=says)
    return judge(measured, criterion, how, fails or "not reached")


@decides("Section 6; Theorem 1", "The bound of Theorem 1 is sharp.", "sharpness", controls=LOOSE)
def sharp_theorem_1(check) -> Finding:
    how = f"in terms of the energy, and in the limit of long chains, {TINY}"
    return judge_sharpness(check, "theorem_1", how)


@decides(
    "Section 6; Theorem 2",
    "The bound of Theorem 2 by the energy of the data is sharp.",
    "sharpness",
    controls=LOOSE,
)
def sharp_theorem_2(check) -> Finding:
    return judge_sharpness(check, "theorem_2", f"in the limit of long chains, {TINY}")


def with_least_constant(check):
    """Return the check with the least C_0 that tiny data allow in place of the proof's."""
    factor = check["proof_constant"] / check["least_constant"]
    ball = check["form"] == "theorem_2_ball"
    return check.assign(reached=check["reached"] * factor.where(ball, 1.0))


@decides(
    "Section 6; Theorem 2, (24)",
    "The bound C_0 delta of Theorem 2 is sharp.",
    "sharpness",
    controls=(
        changed("the least C_0 of tiny data", "sharpness", with_least_constant, confirms=True),
    ),
)
def sharp_theorem_2_ball(check) -> Finding:
    proof, least = (number(check, name) for name in ("proof_constant", "least_constant"))
    fails = f"the constant of the proof is {proof:.3g}, and tiny data need {least:.3g}"
    finding = judge_sharpness(check, "theorem_2_ball", "", fails)
    return finding._replace(
        measured=finding.measured | {"proof_constant": proof, "least_constant": least}
    )


@decides("Section 6; Theorem 3", "The bound of Theorem 3 is sharp.", "sharpness", controls=LOOSE)
def sharp_theorem_3(check) -> Finding:
    how = "at Omega = -4, in the limit of long chains, by A = -B = x (-1)^n at its own energy"
    return judge_sharpness(check, "theorem_3", how)
