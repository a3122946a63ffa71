"""The paper's cases as pendula: their norms, the chaotic state, and which go over the top."""

import numpy as np

from pendula.ledger.changes import exchange, keep, roll, scale
from pendula.ledger.claim import FACTOR, SETTLED, Control, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    UndecidableError,
    WithinFactor,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff
from pendula.measures.confidence import difference_limits, mean_limits
from pendula.numerics.elementary import log

SECTION = 7
PHASES, SEA, TOP = "pendula/phases", "pendula/sea", "pendula/over_the_top"
THERMAL = "unbounded/thermal"
REGULAR = ("fig2_small", "fig2_large", "fig3_small")
SMALL_ANGLES = 0.15
"""Up to this mu the angles of the chaotic state stay below a quarter of a turn."""
SMALL = keep(mu=slice(None, SMALL_ANGLES))
PENDULA = slice(1e-9, None)
"""All mu but 0, which stands for the amplitude equations."""
LARGE_DATA = 0.2
"""Up to this mu the larger data of the paper, at 2 mu 5 rad, stay well below the top."""

ORDER = Cutoff(0.5, "an order counts as the nearest whole number")
SAME = Cutoff(0.05, "P of the thermal state changes by so much if Omega changes by 0.25")
SAME_LAW = Cutoff(0.05, "a smaller difference of distributions is not seen in a figure")


def late_levels(phases, norm: str = "l2"):
    """Return the mean norm of the pair from SETTLED on, (case, mu)."""
    late = phases[norm].sel(tau=slice(SETTLED, None))
    if not late.sizes["tau"]:
        raise UndecidableError(f"the runs end before tau = {SETTLED:g}")
    power = (late * late).sum("component", skipna=False)
    pair = np.sqrt(power) if norm == "l2" else late.max("component", skipna=False)
    return pair.mean("tau", skipna=False)


def known(levels):
    """Return levels none of which is NaN, as where pendula are lost to the drive."""
    if levels.isnull().any():
        raise UndecidableError("a run ended where the drive made pendula over the top ever faster")
    return levels


def at_finite(values):
    """Return values at all mu but 0, which stands for the amplitude equations."""
    found = values.sel(mu=values["mu"] > 0.0)
    if not found.sizes["mu"]:
        raise UndecidableError("no run has a nonzero mu")
    return found


def thermal_beside(sea, thermal, *names: str):
    """Return these variables of the thermal chain at the Omega of `sea`, NaN without a solution."""
    return thermal[list(names)].reindex(omega=[sea.attrs["omega"]]).isel(omega=0, drop=True)


@claim(
    "Section 5, Figs 2 and 3, for the pendula (1)",
    "Where the motion is regular, the l2 norms of the pendula tend to those of Figs 2 and 3 "
    "with an error of the order mu^2.",
    (PHASES,),
    (
        Control(
            "another case as the limit",
            roll("l2", {"case": 1}, mu=0.0),
            on=("fig4_large",),
        ),
        Control(
            "norms with an error of the order mu",
            lambda one: one.assign(l2=one["l2"].sel(mu=0.0) * (1.0 + one["mu"])),
        ),
    ),
    on=REGULAR,
)
def pendula_norms(phases) -> Finding:
    """Take the order of the difference of the mean norms between the two smallest mu."""
    levels = known(late_levels(phases.sel(case=list(REGULAR)))).sortby("mu")
    mu = levels["mu"].values
    if mu.size < 3 or mu[0] != 0.0:
        raise UndecidableError("fewer than two nonzero mu were run, or not the limit")
    off = abs(levels / levels.sel(mu=0.0) - 1.0)
    fine, coarse = off.isel(mu=1), off.isel(mu=2)
    if not (fine > 0.0).all():
        raise UndecidableError("a case does not differ from its limit")
    order = log(np.asarray(coarse / fine)) / log(mu[2] / mu[1])
    measured = {"least_order": order.min(), "largest_order": order.max()}
    measured |= {"largest_difference": fine.max(), "at_mu": mu[1]}
    says = "order in mu of the difference"
    return judge(measured, Near(2.0, ORDER, "least_order", "largest_order", says=says))


@claim(
    "Section 5, Fig 3, for the pendula (1)",
    "For larger initial conditions at Omega = -4 the l2 norm of the pendula grows, whereas the "
    "l-infinity norm stays at its initial level.",
    (PHASES,),
    (
        Control(
            "the smallest mu alone",
            lambda one: one.sel(mu=[0.0, float(at_finite(one)["mu"].min())]),
            confirms=True,
        ),
    ),
    on=("fig3_large",),
)
def pendula_spread(phases) -> Finding:
    """Compare the late norms with those of the data, at each mu."""
    case = phases.sel(case=["fig3_large"])
    start = case.sel(mu=0.0).isel(tau=0)
    l2, linf = np.sqrt((start["l2"] ** 2).sum("component")), start["linf"].max("component")
    grown = at_finite(known(late_levels(case))) / l2
    level = at_finite(known(late_levels(case, "linf"))) / linf
    measured = {
        "least_growth": grown.min(),
        "least_level": level.min(),
        "largest_level": level.max(),
        "mus": grown.sizes["mu"],
    }
    says = "late over initial l-infinity norm"
    criterion = AllOf(
        AtLeast(FACTOR, "least_growth", says="late over initial l2 norm"),
        WithinFactor(FACTOR, "least_level", "largest_level", says=says),
    )
    fails = (
        "the initial condition lies near a boundary between fates: at some mu the motion of the "
        "pendula disperses, and at large mu pendula go over the top"
    )
    return judge(measured, criterion, fails=fails)


@claim(
    "Section 4, Theorem 1, for the pendula (1)",
    "For Omega > 2 gamma + 4 epsilon the bound of Theorem 1 also holds for the pendula.",
    (PHASES,),
    (
        Control(
            "all mu at which the initial angles are well below the top",
            lambda one: one.sel(mu=one["mu"] <= LARGE_DATA, member=one["member_mu"] <= LARGE_DATA),
            confirms=True,
        ),
    ),
    on=("fig2_small", "fig2_large"),
)
def theorem_1_for_the_pendula(phases) -> Finding:
    """Compare the largest P of the envelopes with Theorem 1's bound by the data's energy.

    Members of an ensemble count as runs: where the pendula are chaotic, rounding decides by how
    much one run exceeds the bound, if it does, but not whether one of many does.
    """
    cases = phases.sel(case=["fig2_small", "fig2_large"])
    if not np.isfinite(cases["theorem_1_power"]).all():
        raise UndecidableError("Theorem 1 does not apply to these constants")
    power = (cases["l2"] ** 2).sum("component").max("tau")
    over = at_finite(power / cases["theorem_1_power"]).max("case")
    members = phases["over_theorem_1"].values
    ratios = np.append(over.values, members)
    mus = np.append(over["mu"].values, phases["member_mu"].values)
    beyond = (members > 1.0).sum()
    measured = {
        "largest_over_bound": ratios.max(),
        "at_mu": mus[ratios.argmax()],
        "members_over_bound": beyond,
        "members": members.size,
        "median_of_members": np.median(members) if members.size else np.nan,
    }
    fails = (
        "pendula that start near the top go over it, which the amplitude equations cannot describe;"
        f" {beyond} of {members.size} runs of a perturbed ensemble exceed the bound"
    )
    says = "largest P of the envelopes over its bound"
    return judge(measured, AtMost(1.0, "largest_over_bound", says=says), fails=fails)


@claim(
    "Section 4, Theorem 3, for the pendula (1)",
    "On a finite chain P = |A|^2 + |B|^2 of the pendula never exceeds the bound of Theorem 3.",
    (PHASES, TOP),
    (Control(f"only mu up to {SMALL_ANGLES:g}", {PHASES: SMALL, TOP: SMALL}, confirms=True),),
)
def theorem_3_for_the_pendula(phases, over_the_top) -> Finding:
    """Compare angles alone, which give no more than P, with the bound by the energy of the data."""
    bound = phases["theorem_3_power"]
    cases = at_finite((phases["l2"] ** 2).sum("component").max("tau") / bound).max("case")
    sea = at_finite(over_the_top)["angle_power"].max("member") / bound.sel(case="fig4_small")
    above = [float(one["mu"][(one > 1.0).values].min()) for one in (cases, sea) if one.max() > 1.0]
    measured = {"largest_over_bound": max(cases.max(), sea.max())}
    measured |= {"smallest_mu_over_it": min(above, default=np.nan)}
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
    apart = at_finite(abs(cumulated - cumulated.sel(mu=0.0)))
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
    angles = known(at_finite(over_the_top)["angle_so_far"].isel(tau=-1)).mean("member")
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
    says = "lower confidence limit of the rate at the largest mu less the upper one at the smallest"
    apart = Above(0.0, "gap_of_limits", says=says)
    below = np.maximum.accumulate(rated["passage_rate_low"].values)
    within = (rated["passage_rate_high"].values >= below).all()
    if apart.holds(measured) and measured["least_step"] <= 0.0 and within:
        return undecided(measured, "a rate falls with mu, but by less than its confidence interval")
    rises = Above(0.0, "least_step", says="least increase of the rate from one mu to the next")
    return judge(measured, AllOf(apart, rises))
