"""How far the expansion (3) holds: its order, its next order, and for how long."""

import numpy as np

from pendula.ledger.changes import scale
from pendula.ledger.claim import FACTOR, Control, claim
from pendula.ledger.criterion import AllOf, Below, Finding, Near, UndecidableError, judge
from pendula.ledger.cutoff import Cutoff
from pendula.numerics.elementary import log

SECTION = 7
PLACE = "Section 2, (3), for the pendula (1)"
REMAINDER, LYAPUNOV = "pendula/remainder", "checks/lyapunov"
STABLE = ("fig2_small", "fig2_large", "fig3_small", "fig3_large")
"""Cases whose chain at rest is stable."""
UNSTABLE = "fig4_small"
ALL = (*STABLE, "fig4_small", "fig4_large")
SLOW, OPPOSITE = "the slow time mu^2 t", "a third harmonic of the opposite sign"
"""Wrong expansions."""

WHOLE = Cutoff(0.03, "an order counts as a whole number if it differs from one by up to 0.03")
SECULAR = Cutoff(1.5, "the exponent of time is nearer to 1 than to 2", 1.0)
TOLD = Cutoff(1.0, "nearer to the order of the expansion than to the next one, larger by 2")
LONG = 10.0
"""A run that tells how the remainder grows goes on to here at least, where the paper takes its
chains for settled."""
SPAN = 4.0
"""The remainder of all cases is followed to here at least: chaos has grown by a thousand then."""
FEWEST = 3
"""So many mu at least: any two horizons make a line."""


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
    names = "order", "order_uncertainty", "error_constant"
    order, off, constant = (remainder[name].sel(chosen) for name in names)
    if not all(np.isfinite(one).all() for one in (order, off, constant)):
        raise UndecidableError("an order requires three mu, each half of the one before")
    measured = {
        "least_order": order.min(),
        "largest_order": order.max(),
        "off_by_at_most": off.max(),
        "least_constant": constant.min(),
        "largest_constant": constant.max(),
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
    fact="order of the expansion",
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


def over_late_half(remainder, cases, long: float):
    """Return a mu, an end, and by case how much the error grows in the late half up to that end.

    It is the smallest mu whose runs of all `cases` go on to `long`, and the last end of them.
    """
    ends = remainder["pendula_end"].sel(case=list(cases)).min("case")
    followed = ends.values >= long
    if not followed.any():
        raise UndecidableError(f"at no mu do all these runs last to tau = {long:g}")
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
    mu, late, growth = over_late_half(remainder, ALL, SPAN)
    caveat = (
        f"as mu goes to 0 at a fixed slow time, here tau = {end:g}; with tau it grows: at mu = "
        f"{mu:g} and up to tau = {late:g} it is {float(growth.min()):.3g} to "
        f"{float(growth.max()):.3g} times as large as in the first half"
    )
    times = float(mus[1] * mus[1] / (mus[0] * mus[0]))
    says = f"growth of the remainder over mu^3 at tau = {end:g} as t grows {times:g} times"
    return judge(measured, Below(FACTOR, *measured, says=says), caveat)


@claim(
    PLACE,
    "Where the chain at rest is stable, the remainder in the small cases grows no faster than in "
    "proportion to time.",
    (REMAINDER,),
    (
        Control(
            "errors in proportion to tau^2",
            lambda one: one.assign(error=0.0 * one["error"].fillna(0.0) + one["end"] ** 2),
        ),
    ),
    on=("fig2_small", "fig3_small"),
)
def remainder_secular(remainder) -> Finding:
    """Read the exponent of time off the late half of the runs."""
    mu, end, growth = over_late_half(remainder, ("fig2_small", "fig3_small"), LONG)
    exponents = log(growth.values) / log(2.0)
    measured = {"largest_exponent": exponents.max(), "mu": mu, "up_to_tau": end}
    return judge(measured, Below(SECULAR, "largest_exponent", says="exponent of time"))


def slopes(remainder):
    """Return by expansion how much later the horizon comes at mu / e than at mu."""
    found = {}
    for horizon in remainder["visible_from"].sel(case=UNSTABLE).transpose("expansion", "mu"):
        known = horizon[np.isfinite(horizon.values)].sortby("mu")
        if known.size < FEWEST:
            raise UndecidableError(f"fewer than {FEWEST} runs reach their horizon")
        mus = known["mu"].values
        apart = log(float(mus[-1]) / float(mus[0]))
        found[str(horizon["expansion"].values)] = float(known[0] - known[-1]) / apart
    return found


def by_power(remainder):
    """Return horizons in proportion to mu^-2, as an error that does not grow would have them."""
    first, mu = remainder["visible_from"].isel(mu=0), remainder["mu"]
    return remainder.assign(visible_from=first * (mu[0] / mu) ** 2)


@claim(
    PLACE,
    "At Omega = 0 the expansion holds only for a slow time in proportion to ln(1 / mu) over the "
    "Lyapunov exponent.",
    (REMAINDER, LYAPUNOV),
    (
        Control("horizons in proportion to mu^-2", {REMAINDER: by_power}),
        Control("horizons 50 % later", {REMAINDER: scale("visible_from", 1.5)}),
    ),
    on=(UNSTABLE,),
)
def horizon_logarithmic(remainder, lyapunov) -> Finding:
    """An error of mu^3 e^(rate tau) is a part of an angle of the order mu at 2 ln(1 / mu) / rate.

    With the next order it is twice as late.
    """
    rate = float(lyapunov["exponent"].sel(case=UNSTABLE).max())
    if not rate > 0.0:
        raise UndecidableError("no positive Lyapunov exponent is known")
    found = slopes(remainder)
    horizon = remainder["visible_from"].sel(case=UNSTABLE, expansion="leading").values
    known = np.isfinite(horizon)
    measured = {
        "leading_order": found["leading"] * rate,
        "corrected_order": found["corrected"] * rate,
        "rate": rate,
        "latest": horizon[known].max(),
        "at_mu": remainder["mu"].values[known].min(),
    }
    says = "slope of the horizon against ln(1 / mu), times the exponent"
    criterion = AllOf(
        Near(2.0, TOLD, "leading_order", says=says),
        Near(4.0, TOLD, "corrected_order", says=f"{says}, with the next term"),
    )
    until = measured["latest"]
    caveat = f"the horizons end at tau = {until:.2g}, but the Lyapunov exponent is measured later"
    return judge(measured, criterion, caveat)
