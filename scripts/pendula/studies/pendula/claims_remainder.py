"""How far the expansion (3) holds: its order, its next order, and that it stays bounded."""

import numpy as np

from pendula.ledger.claim import FACTOR, Control, claim
from pendula.ledger.criterion import Below, Finding, Near, UndecidableError, judge
from pendula.ledger.cutoff import Cutoff

SECTION = 7
PLACE = "Section 2, (3), for the pendula (1)"
REMAINDER = "pendula/remainder"
STABLE = ("fig2_small", "fig2_large", "fig3_small", "fig3_large")
"""Cases whose chain at rest is stable."""
ALL = (*STABLE, "fig4_small", "fig4_large")
SLOW, OPPOSITE = "the slow time mu^2 t", "a third harmonic of the opposite sign"
"""Wrong expansions."""

WHOLE = Cutoff(0.03, "an order counts as a whole number if it differs from one by up to 0.03")
SPAN = 4.0
"""The remainder of all cases is followed to here at least: chaos has grown by a thousand then."""


def common_end(remainder) -> float:
    """Return the last end that every run reaches."""
    known = remainder["error"].notnull().all(("expansion", "case", "mu")).values
    if not known.any():
        raise UndecidableError("no slow time is reached by every run")
    return float(remainder["end"].values[known].max())


def of_wrong(name: str, reading: str, expansion: str):
    """Return what gives an expansion the orders, or the errors, of a wrong one."""

    def changed(remainder):
        wrong = remainder[f"wrong_{name}"].sel(wrong_expansion=reading)
        here = remainder["expansion"] == expansion
        return remainder.assign({name: remainder[name].where(~here, wrong)})

    return changed


def judged_order(remainder, expansion: str, whole: float, cases=STABLE) -> Finding:
    """Require one order of every case, at the end that every run reaches."""
    chosen = {"expansion": expansion, "case": list(cases), "end": common_end(remainder)}
    order, off = (remainder[name].sel(chosen) for name in ("order", "order_uncertainty"))
    if not np.isfinite(order).all():
        raise UndecidableError("an order requires three mu, each half of the one before")
    measured = {
        "least_order": order.min(),
        "largest_order": order.max(),
        "off_by_at_most": off.max(),
        "up_to_tau": common_end(remainder),
    }
    says = "order in mu of the error of the angles"
    return judge(measured, Near(whole, WHOLE, "least_order", "largest_order", says=says))


@claim(
    "Section 2, after (3)",
    "The expansion is justified on times of the order mu^-2: up to a tau of order 1 the angles of "
    "(3) and (4) differ from those of the pendula by the order mu^3.",
    (REMAINDER,),
    (Control("amplitudes with the slow time mu^2 t", of_wrong("order", SLOW, "leading")),),
    on=ALL,
)
def expansion_order(remainder) -> Finding:
    return judged_order(remainder, "leading", 3.0, ALL)


@claim(
    PLACE,
    "With its next term the expansion differs from the pendula by the order mu^5.",
    (REMAINDER,),
    (
        Control(OPPOSITE, of_wrong("order", OPPOSITE, "corrected")),
        Control(
            "the third harmonic with the amplitudes of (4)",
            of_wrong("order", "a third harmonic alone", "corrected"),
        ),
    ),
    on=ALL,  # the orders are taken at the end that every run reaches
)
def next_order_of_the_expansion(remainder) -> Finding:
    return judged_order(remainder, "corrected", 5.0)


def over_late_half(remainder, cases):
    """Return a mu, an end, and by case how much the error grows in the late half up to that end.

    It is the smallest mu whose runs go on to SPAN, and the last end of them.
    """
    ends = remainder["pendula_end"]
    followed = ends.values >= SPAN
    if not followed.any():
        raise UndecidableError(f"at no mu do the runs last to tau = {SPAN:g}")
    mu = float(ends["mu"].values[followed].min())
    end = float(ends.sel(mu=mu))
    errors = remainder["error"].sel(case=list(cases), expansion="leading", mu=mu)
    return mu, end, errors.sel(end=end) / errors.sel(end=0.5 * end, method="nearest")


@claim(
    "Section 2, before (4)",
    "The remainder of the expansion stays bounded as the system evolves.",
    (REMAINDER,),
    (Control("amplitudes with the slow time mu^2 t", of_wrong("error", SLOW, "leading")),),
    on=ALL,
)
def remainder_bounded(remainder) -> Finding:
    """Compare the remainder at two mu and one slow time: t is four times as late at half of the mu.

    That is the condition from which (4) follows: no term of the remainder grows in proportion to t.
    """
    end, expansion = common_end(remainder), {"expansion": "leading", "case": list(ALL)}
    errors = remainder["error"].sel(end=end, **expansion).sortby("mu").isel(mu=[0, 1])
    if not np.isfinite(errors).all():
        raise UndecidableError("fewer than two mu have runs of all cases to a common slow time")
    mus = errors["mu"]
    fine, coarse = (errors / (mus * mus * mus)).transpose("mu", "case").values
    measured = {f"growth_{case}": one for case, one in zip(ALL, fine / coarse, strict=True)}
    mu, late, growth = over_late_half(remainder, ALL)
    caveat = (
        f"as mu goes to 0 at a fixed slow time, here tau = {end:g}; with tau it grows: at mu = "
        f"{mu:g} and up to tau = {late:g} it is {float(growth.min()):.3g} to "
        f"{float(growth.max()):.3g} times as large as in the first half"
    )
    times = float(mus[1] * mus[1] / (mus[0] * mus[0]))
    says = f"growth of the remainder over mu^3 at tau = {end:g} as t grows {times:g} times"
    return judge(measured, Below(FACTOR, *measured, says=says), caveat)
