"""The chaotic state of the pendula, and when they go over the top."""

import numpy as np
from latticode.measures.confidence import difference_limits, mean_limits

from pendula.ledger.changes import exchange, keep, roll, scale
from pendula.ledger.claim import FACTOR, Control, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff

SECTION = 7
SEA, TOP = "pendula/sea", "pendula/over_the_top"
THERMAL = "unbounded/thermal"
SMALL_ANGLES = 0.15
"""Up to this mu the angles of the chaotic state stay below a quarter of a turn."""
SMALL = keep(mu=slice(None, SMALL_ANGLES))
PENDULA = slice(1e-9, None)
"""All mu but 0, which stands for the amplitude equations."""

SAME = Cutoff(0.05, "P of the thermal state changes by so much if Omega changes by 0.25")
SAME_LAW = Cutoff(0.05, "a smaller difference of distributions is not seen in a figure")


def known(angles):
    """Return angles none of which is NaN, as where pendula are lost to the drive."""
    if angles.isnull().any():
        raise UndecidableError("a run ended where the drive made pendula over the top ever faster")
    return angles


def thermal_beside(sea, thermal, *names: str):
    """Return these variables of the thermal chain at the Omega of `sea`, NaN without a solution."""
    return thermal[list(names)].reindex(omega=[sea.attrs["omega"]]).isel(omega=0, drop=True)


@claim(
    "Section 4, Theorem 3, for the pendula (1)",
    "On a finite chain P = |A|^2 + |B|^2 of the pendula never exceeds the bound of Theorem 3.",
    (TOP,),
    (Control(f"only mu up to {SMALL_ANGLES:g}", {TOP: SMALL}, confirms=True),),
)
def theorem_3_for_the_pendula(over_the_top) -> Finding:
    """Compare angles alone, which give no more than P, with the bound by the energy of the data."""
    over = (over_the_top["angle_power"] / over_the_top["theorem_3_power"]).max("member")
    beyond = over["mu"].values[(over > 1.0).values]
    measured = {"largest_over_bound": over.max()}
    measured |= {"smallest_mu_over_it": min(beyond, default=np.nan)}
    fails = (
        "no energy bounds driven pendula: over the top they keep rotating and wind up the strings"
    )
    says = "largest P over its bound"
    return judge(measured, AtMost(1.0, "largest_over_bound", says=says), fails=fails)


@claim(
    "Section 5, Fig 4, for the pendula (1)",
    "At Omega = 0 and small mu the pendula reach the same chaotic state as the amplitudes.",
    (SEA, THERMAL),
    (
        Control("angles in place of their envelope", {SEA: scale("site_power", 0.5, mu=PENDULA)}),
        Control("the thermal state of another detuning", {THERMAL: roll("power", {"omega": 1})}),
        Control(
            "distributions of the pendula shifted by four bins",
            {SEA: roll("modulus_share", {"modulus": 4}, mu=PENDULA)},
        ),
    ),
)
def same_sea(sea, thermal) -> Finding:
    """Compare P a site and the distribution of moduli, of ensembles on one chain."""
    limit, *others = (sea["site_power"].sel(mu=mu).values for mu in sea["mu"].values)
    if sea.sizes["member"] < 2 or not others:
        raise UndecidableError("the ensemble has fewer than two members, or no pendula")
    known = thermal_beside(sea, thermal, "power")["power"]
    if np.isnan(known):
        raise UndecidableError("the thermal state at the Omega of the ensemble was not computed")
    away = [difference_limits(one, limit) for one in others]
    cumulated = sea["modulus_share"].mean("member").cumsum("modulus")
    apart = abs(cumulated - cumulated.sel(mu=0.0))
    measured = {
        "largest_difference": max(abs(one.value) for one in away) / limit.mean(),
        "its_limits": max(one.half for one in away) / limit.mean(),
        "from_thermal": max(abs(mean_limits(one).value / float(known) - 1.0) for one in others),
        "laws_apart": apart.max(),
    }
    says = "relative difference of P per site, and half of its confidence interval"
    criterion = AllOf(
        Below(SAME, "largest_difference", "its_limits", says=says),
        Below(SAME, "from_thermal", says="relative difference of P from that of the thermal state"),
        Below(SAME_LAW, "laws_apart", says="largest difference of the distributions of moduli"),
    )
    return judge(measured, criterion)


@claim(
    "Abstract and Section 6, for the pendula (1)",
    "While the l2 norm of the pendula at Omega = 0 grows, their l-infinity norm remains finite, at "
    "the level of that of the amplitudes.",
    (TOP, SEA),
    (Control(f"only mu up to {SMALL_ANGLES:g}", {TOP: SMALL}, confirms=True),),
)
def pendula_stay_below_the_top(over_the_top, sea) -> Finding:
    """Compare the largest angle by the end with 2 mu times the amplitudes' level."""
    level = sea["linf_level"].sel(mu=0.0).mean("member")
    angles = known(over_the_top["angle_so_far"].isel(tau=-1)).mean("member")
    over = angles / (2.0 * over_the_top["mu"] * level)
    passed = over_the_top["passed"].isel(tau=-1)
    measured = {
        "largest_over_level": over.max(),
        "largest_share_over_the_top": passed.max(),
        "least_share_over_the_top": passed.min(),
        "least_share_upper_limit": over_the_top["passed_high"].isel(tau=-1).min(),
        "members": over_the_top.sizes["member"],
    }
    says = "largest angle by the end over 2 mu times the mean l-infinity norm of the amplitudes"
    fails = "at larger mu some pendula go over the top after a while and keep rotating"
    return judge(measured, Below(FACTOR, "largest_over_level", says=says), fails=fails)


def with_middle_exchanged(over_the_top):
    """Return the rates, by mu, with two in the middle of the known ones exchanged."""
    ordered = over_the_top.sortby("mu")
    places, known = np.arange(ordered.sizes["mu"]), np.isfinite(ordered["passage_rate"].values)
    middle = np.flatnonzero(known)[known.sum() // 2 - 1 :][:2]
    places[middle] = middle[::-1]
    return ordered.isel(mu=places).assign_coords(mu=ordered["mu"].values)


@claim(
    "Section 6, for the pendula (1)",
    "The smaller mu is, the longer it takes in the chaotic state until a pendulum goes over the "
    "top.",
    (TOP,),
    (
        Control("mu in reverse order", exchange("mu")),
        Control(
            "the same passage rates at all mu",
            lambda one: one.isel(mu=[0] * one.sizes["mu"]).assign_coords(mu=one["mu"].values),
        ),
        Control("two middle rates exchanged", with_middle_exchanged, undecided=True),
    ),
)
def waiting_grows(over_the_top) -> Finding:
    """Require rates that rise with mu at every step, with distinct limits from end to end."""
    ordered = over_the_top.sortby("mu")
    rated = ordered.sel(mu=np.isfinite(ordered["passage_rate"]).values)
    if rated.sizes["mu"] < 2:
        raise UndecidableError("passage rates are known at fewer than two mu")
    slow, fast = rated.isel(mu=0), rated.isel(mu=-1)
    measured = {
        "rate": fast["passage_rate"],
        "at_mu": fast["mu"],
        "slower_rate": slow["passage_rate"],
        "at_smaller_mu": slow["mu"],
        "gap_of_limits": fast["passage_rate_low"] - slow["passage_rate_high"],
        "least_step": rated["passage_rate"].diff("mu").min(),
    }
    says = "lower confidence limit of the rate at the largest mu minus the upper at the smallest"
    apart = Above(0.0, "gap_of_limits", says=says)
    below = np.maximum.accumulate(rated["passage_rate_low"].values)
    within = (rated["passage_rate_high"].values >= below).all()
    if apart.holds(measured) and measured["least_step"] <= 0.0 and within:
        return undecided(measured, "a rate falls with mu, but by less than its confidence interval")
    rises = Above(0.0, "least_step", says="least increase of the rate from one mu to the next")
    return judge(measured, AllOf(apart, rises))
