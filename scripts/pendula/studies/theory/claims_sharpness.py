"""Section 6: how sharp the bounds on the l2 norms are, theorem by theorem and form by form.

A bound in terms of the energy is one thing, a constant times the size of the data another: the
paper has both, and says "sharp" of all.
"""

from pendula.ledger.changes import scale, take
from pendula.ledger.claim import Control, checks, claim, number
from pendula.ledger.criterion import Above, Finding, judge, undecided
from pendula.ledger.cutoff import Cutoff

SECTION = 6

SHARP = Cutoff(0.9, '"sharp": at least 90 % of the bound is reached', ideal=1.0)


@claim(
    "Section 6; Theorems 1 to 3",
    "The bounds of Theorems 1, 2 and 3 in terms of the initial energy are sharp.",
    checks("sharpness"),
    controls=(Control("bounds 25 % too large", scale("reached", 0.8)),),
)
def sharp_theorems(check) -> Finding:
    measured = {
        form: float(check["reached"].sel(form=form))
        for form in ("theorem_1", "theorem_2", "theorem_3")
    }
    how = (
        "in the limit of long chains: the bounds of Theorems 1 and 2 are reached by a tiny wave at "
        "the edge of the band, that of Theorem 3 at Omega = -4 by A = -B = x (-1)^n"
    )
    return judge(measured, Above(SHARP, *measured, says="share of each bound that is reached"), how)


def with_least_constant(check):
    """Return the check with the least C_0 that tiny data allow in place of the proof's."""
    return take(limit_constant="least_constant")(
        scale("reached", check["limit_constant"] / check["least_constant"])(check)
    )


@claim(
    "Section 6; Theorem 2, (24)",
    "The bound C_0 delta of Theorem 2 is sharp.",
    checks("sharpness"),
    controls=(
        Control("the least C_0 for tiny initial conditions", with_least_constant, confirms=True),
        Control("initial conditions that reach half of that", scale("reached", 0.5)),
    ),
)
def sharp_theorem_2_ball(check) -> Finding:
    """The paper gives no C_0: it may be the least one, or that of the inequality in its proof."""
    limit, least = (number(check, name) for name in ("limit_constant", "least_constant"))
    by_limit = float(check["reached"].sel(form="theorem_2_ball"))
    measured = {"share": by_limit, "share_with_least_constant": by_limit * limit / least}
    measured |= {"limit_constant": limit, "least_constant": least}
    sharp = Above(SHARP, *list(measured)[:2], says="share of the bound that is reached")
    if sharp.failing(measured) == ["share"]:
        return undecided(
            measured,
            f"the paper gives no C_0: its inequality gives C_0 = {limit:.3g} as delta goes to 0, "
            f"of which {by_limit:.0%} is reached, and C_0 = {least:.3g} is enough",
        )
    return judge(measured, sharp)
