"""Section 6: how sharp the bounds on the l2 norms are, theorem by theorem and form by form.

A bound in terms of the energy is one thing, a constant times the size of the data another: the
paper has both, and says "sharp" of all.
"""

from pendula.ledger.changes import scale
from pendula.ledger.claim import Control, checks, claim, number
from pendula.ledger.criterion import Above, Finding, judge
from pendula.ledger.cutoff import Cutoff

SECTION = 6

SHARP = Cutoff(0.9, '"sharp": at least 90 % of the bound is reached', ideal=1.0)


def on_chains(check, form: str) -> dict[str, float]:
    """Return what part of a bound is reached on the shortest and on the longest chain."""
    ends = check["reached"].sel(form=form)[[0, -1]]
    return {f"{form}_on_{int(one['sites'])}_sites": float(one) for one in ends}


@claim(
    "Section 6; Theorems 1 to 3",
    "The bounds of Theorems 1, 2 and 3 in terms of the initial energy are sharp.",
    checks("sharpness"),
    controls=(Control("bounds 25 % too large", "checks/wrong/sharpness"),),
)
def sharp_theorems(check) -> Finding:
    """What the longest chain reaches decides."""
    by_form = [on_chains(check, form) for form in ("theorem_1", "theorem_2", "theorem_3")]
    longest, sites = [list(found)[-1] for found in by_form], int(check["sites"][-1])
    says = f"share of each bound that is reached on {sites} sites"
    how = (
        "in the limit of long chains: the bounds of Theorems 1 and 2 are reached by a tiny wave at "
        "the edge of the band, that of Theorem 3 at Omega = -4 by A = -B = x (-1)^n"
    )
    measured = {key: one for found in by_form for key, one in found.items()}
    return judge(measured, Above(SHARP, *longest, says=says), how)


def with_least_constant(check):
    """Return the check with the least C_0 that tiny data allow in place of the proof's."""
    factor = check["limit_constant"] / check["least_constant"]
    return scale("reached", factor, form="theorem_2_ball")(check)


@claim(
    "Section 6; Theorem 2, (24)",
    "The bound C_0 delta of Theorem 2 is sharp.",
    checks("sharpness"),
    controls=(
        Control("the least C_0 for tiny initial conditions", with_least_constant, confirms=True),
    ),
)
def sharp_theorem_2_ball(check) -> Finding:
    """The paper gives no C_0, so it is the least one that its inequality allows tiny data."""
    measured = on_chains(check, "theorem_2_ball")
    longest, sites = list(measured)[-1], int(check["sites"][-1])
    limit, least = (number(check, name) for name in ("limit_constant", "least_constant"))
    fails = (
        f"the paper gives no C_0; its inequality gives C_0 = {limit:.3g} as delta goes to 0, but"
        f" C_0 = {least:.3g} is enough, so only {measured[longest]:.0%} of the bound is reached"
    )
    criterion = Above(SHARP, longest, says=f"share of the bound that is reached on {sites} sites")
    constants = {"limit_constant": limit, "least_constant": least}
    return judge(measured | constants, criterion, fails=fails)
