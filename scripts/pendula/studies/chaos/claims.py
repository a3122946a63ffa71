"""What the paper says of chaotic figures against time, of ensembles in place of single runs.

One run is one draw, and what it shows need not hold for the next. So each sentence is tested on
two ensembles, even in n as the true solution is, and uneven as an ordinary solver makes it. A
sentence holds where the confidence limits of both satisfy the criterion.
"""

from collections.abc import Callable
from functools import partial

import numpy as np
from latticode.measures.confidence import (
    CONFIDENCE,
    Limits,
    difference_limits,
    mean_limits,
    share_limits,
)
from latticode.measures.difference import VISIBLE

from pendula.ledger.changes import exchange, repeat
from pendula.ledger.chaos import FAR_AS_NEAR, SENSITIVITY, almost_equal
from pendula.ledger.claim import CHANGE, FACTOR, MUCH, Control, checks, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    UndecidableError,
    WithinFactor,
    judge,
)
from pendula.ledger.cutoff import Cutoff, once
from pendula.ledger.missing import FEWEST

SECTION = 5
NEEDS = checks("members")
EARLIER, LATER = "[10, 30]", "[30, 50]"
"""The halves of the time over which the paper takes its statistics."""

LEVEL = Cutoff(CONFIDENCE, "the customary level of confidence, 95 %", 1.0)
SEEN = Cutoff(VISIBLE, "a reader sees a difference of 1 % of full scale")
BAND = Cutoff(1.0, '"no visible differences": smaller than the band over which runs scatter')
SEVERAL = Cutoff(3.0, '"other pendula": more than three')
MANY = Cutoff(0.25, '"many pendula": a quarter of all')
ANTICORRELATED = Cutoff(
    -0.8,
    '"mix up": not an exchange, in which |A|^2 and |B|^2 are anticorrelated',
    -1.0,
)
ALL = Cutoff(0.9, '"does not depend": nine of ten runs make it at every amplitude', 1.0)

END = 50.0
"""The paper runs Figs 2 to 4 up to this time."""
PAPERS_LARGEST = 5.0
"""A_0 of the paper's large initial condition."""


def limits(members, case: str, reduce: Callable, *given) -> dict[str, Limits]:
    """Return the limits of the mean over the members of a case, by kind of ensemble.

    `reduce` makes one number of each member from the dataset of the case and what is `given`.
    """
    known = {EARLIER, LATER} <= set(members["window"].values)
    if case not in members["case"].values or not known:
        raise UndecidableError(f"there is no ensemble of {case} on {EARLIER} and {LATER}")
    if members.sizes["member"] < FEWEST:
        raise UndecidableError(f"the ensemble has fewer than {FEWEST} members")
    return {
        kind: mean_limits(reduce(members_of(members, kind, case), *given), LEVEL.value)
        for kind in map(str, members["kind"].values)
    }


@once
def members_of(members, kind: str, case: str):
    """Return the dataset of one kind of ensemble of a case."""
    return members.sel(kind=kind, case=case)


def named(found: dict[str, Limits], part: str, name: str = "") -> dict[str, float]:
    """Return one part of the limits, "value", "low" or "high", as measured numbers by kind."""
    ends = [name, "" if part == "value" else part]
    return {
        "_".join(filter(None, (kind, *ends))): float(getattr(limit, part))
        for kind, limit in found.items()
    }


# What each member is reduced to, from the dataset of a case, (member,)


@once
def level(case, norm: str, window: str = LATER, quantity: str = "pair") -> np.ndarray:
    """Return the mean of a norm over a window."""
    return case[f"{norm}_level"].sel(window=window, quantity=quantity).values


def over_start(case, norm: str) -> np.ndarray:
    """Return the late mean of a norm over that of the data."""
    return level(case, norm) / float(case[f"{norm}_start"])


def change(case, norm: str) -> np.ndarray:
    """Return the relative change of a norm between the halves."""
    return level(case, norm) / level(case, norm, EARLIER) - 1.0


def pendula(case) -> np.ndarray:
    """Return the late root mean square amplitudes of all pendula, (member, component, site)."""
    late = case["rms"].sel(window=LATER).dropna("site", how="all")
    return late.transpose("member", "component", "site").values


def distance(found: dict[str, Limits]) -> dict[str, Limits]:
    """Return the limits with the end that is further from zero as the upper one of the size."""
    return {
        kind: Limits(abs(limit.value), 0.0, max(abs(limit.low), abs(limit.high)))
        for kind, limit in found.items()
    }


# --- Wrong cases ----------------------------------------------------------------------------------

WORDS = {
    "fig2_small": "the small case at Omega = 8, which is stable",
    "fig2_large": "the large case at Omega = 8, which is stable",
    "fig3_small": "the small case at Omega = -4, which is stable",
    "fig3_large": "the large case at Omega = -4, which has not filled the chain",
    "fig4_small": "the small case at Omega = 0, which grows",
}


def wrong_cases(right: str, *wrongs: str) -> tuple[Control, ...]:
    """Return controls: the members of other cases in place of those of `right`."""
    return tuple(
        Control(WORDS[name], {"members": repeat("case", name, at=right)}, on=(right, name))
        for name in wrongs
    )


# --- Fig 3, lower ---------------------------------------------------------------------------------


def fig3(says: str, *wrongs: str) -> Callable:
    """Return the decorator of a claim, whose controls are members of these other cases.

    It needs the shares of runs that spread as well, and they must not spread by data far away.
    """
    place, needs = "Section 5, Fig 3 lower, in ensembles", (*NEEDS, SENSITIVITY)
    controls = (*wrong_cases("fig3_large", *wrongs), FAR_AS_NEAR)
    return claim(place, says, needs, controls, ("fig3_large",))


@fig3("As a result, the l2 norm of the solution grows.", "fig3_small", "fig2_large", "fig2_small")
def ensemble_fig3_grows(members, sensitivity) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])
    found = limits(members, "fig3_large", over_start, "l2")
    lows = named(found, "low")
    says = f"lower confidence limit of the mean l2 on {LATER} over its initial value"
    return near.judge(named(found, "value") | lows, Above(FACTOR, *lows, says=says))


@fig3(
    "The central pendulum excites large oscillations of other pendula in the chain.",
    "fig3_small",
    "fig2_large",
    "fig2_small",
)
def ensemble_fig3_excites(members, sensitivity) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])

    def excited(case):
        amplitudes = pendula(case)
        others = np.delete(amplitudes, amplitudes.shape[2] // 2, axis=2)
        return (others > float(case["linf_start"]) / MUCH.value).sum(axis=(1, 2))

    found = limits(members, "fig3_large", excited)
    lows = named(found, "low")
    says = f"lower confidence limit of the number of other pendula above A_0 / 3 on {LATER}"
    return near.judge(named(found, "value") | lows, Above(SEVERAL, *lows, says=says))


@fig3("The A and B modes mix up.", "fig2_large", "fig2_small", "fig3_small")
def ensemble_fig3_mixes(members, sensitivity) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])

    def ratio(case):
        return level(case, "l2", LATER, "A") / level(case, "l2", LATER, "B")

    def correlation(case):
        return case["norm_correlation"].sel(window=LATER).values

    ratios, exchange = (limits(members, "fig3_large", each) for each in (ratio, correlation))
    ends = named(ratios, "low", "ratio") | named(ratios, "high", "ratio")
    together = named(exchange, "low", "correlation")
    alike = WithinFactor(FACTOR, *ends, says="confidence interval of l2 of A over that of B")
    says = "lower confidence limit of the correlation of |A|^2 and |B|^2"
    return near.judge(ends | together, alike, Above(ANTICORRELATED, *together, says=says))


@fig3(
    "The l-infinity norm stays at its initial level.",
    *("fig4_small", "fig2_small", "fig3_small"),
)
def ensemble_fig3_maximum(members, sensitivity) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])
    found = limits(members, "fig3_large", over_start, "linf")
    ends = named(found, "low") | named(found, "high")
    rise = min(limit.low for limit in found.values()) - 1.0
    rises = f"it rises by at least {rise:.0%}" if rise > 0.0 else ""
    says = f"confidence interval of the mean l-infinity norm on {LATER} over its initial value"
    alike = WithinFactor(FACTOR, *ends, says=says)
    return near.judge(named(found, "value") | ends, alike, caveat=rises)


# --- Fig 4 ----------------------------------------------------------------------------------------

BOTH = ("fig4_small", "fig4_large")
fig4 = partial(claim, "Section 5, Fig 4, in ensembles", needs=NEEDS, on=BOTH)


def of_both(members, *reduce) -> dict[str, Limits]:
    """Return the limits of both panels of Fig 4, by size of the data and kind."""
    return {
        f"{case.removeprefix('fig4_')}_{kind}": limit
        for case in BOTH
        for kind, limit in limits(members, case, *reduce).items()
    }


@fig4(
    "The growth of oscillation amplitudes stabilises at a certain level of the l-infinity norm, and"
    " the l2 norm is significantly larger than the l-infinity norm.",
    controls=(
        *wrong_cases("fig4_small", "fig2_small", "fig3_small", "fig3_large"),
        *wrong_cases("fig4_large", "fig2_large"),
    ),
)
def ensemble_fig4_settles(members) -> Finding:
    changes = named(distance(of_both(members, change, "linf")), "high", "change")
    grown = named(limits(members, "fig4_small", over_start, "linf"), "low", "growth")
    ratio = of_both(members, lambda case: level(case, "l2") / level(case, "linf"))
    over = named(ratio, "low", "l2_over_linf")
    l2_grown = named(of_both(members, over_start, "l2"), "low", "l2_growth")
    criterion = AllOf(
        Below(CHANGE, *changes, says=f"upper confidence limit of the change to {LATER}"),
        Above(FACTOR, *grown, says="lower confidence limit of the growth in the small case"),
        Above(MUCH, *over, says=f"lower confidence limit of l2 over l-infinity on {LATER}"),
        Above(FACTOR, *l2_grown, says="lower confidence limit of the growth of l2"),
    )
    return judge(changes | grown | over | l2_grown, criterion)


@claim(
    "Section 5, Fig 4",
    "Many pendula oscillate with large and comparable amplitudes with respect to the central one.",
    NEEDS,
    controls=(
        *wrong_cases("fig4_large", "fig2_large"),
        *wrong_cases("fig4_small", "fig2_small", "fig3_small"),
    ),
    on=BOTH,
)
def ensemble_fig4_many(members) -> Finding:
    def share(case):
        amplitudes = pendula(case)
        centre = amplitudes[:, :, amplitudes.shape[2] // 2].max(axis=1)[:, None, None]
        large = amplitudes > float(case["linf_start"]) / MUCH.value
        return ((amplitudes > centre / FACTOR.value) & large).mean(axis=(1, 2))

    lows = named(of_both(members, share), "low")
    says = "lower confidence limit of the share above half of the centre and A_0 / 3"
    return judge(lows, Above(MANY, *lows, says=says))


def fig4_differences(members, norm: str, window: str) -> dict[str, Limits]:
    """Return lower less upper panel of a norm over a window, as a part of the lower, by kind."""
    limits(members, BOTH[0], level, norm, window)  # says what is missing
    found = {}
    for kind in map(str, members["kind"].values):
        small, large = (level(members_of(members, kind, case), norm, window) for case in BOTH)
        found[kind] = difference_limits(large / large.mean(), small / large.mean(), LEVEL.value)
    return found


@fig4(
    "There are no visible differences between the upper and lower panels.",
    controls=(
        *wrong_cases("fig4_small", "fig3_large", "fig3_small"),
        Control(
            "the lower panel in place of the upper one",
            repeat("case", "fig4_large", at="fig4_small"),
            confirms=True,
            on=BOTH,
        ),
    ),
)
def ensemble_fig4_alike(members) -> Finding:
    """Each panel shows one run, so that a difference is seen where it is wider than their band."""
    earlier, later = (fig4_differences(members, "l2", window) for window in (EARLIER, LATER))
    ends = named(distance(earlier), "high", "earlier") | named(distance(later), "high", "later")
    bands = members["relative_width"].sel(case="fig4_large")
    over = {
        f"{name}_over_band": value / float(bands.sel(kind=name.partition("_")[0]))
        for name, value in ends.items()
    }
    measured = named(earlier, "value", "earlier") | named(later, "value", "later") | ends | over
    means = [abs(limit.value) for limit in (*earlier.values(), *later.values())]
    caveat = (
        f"the means differ by {min(means):.1%} to {max(means):.1%}, most on {EARLIER}, since the"
        f" small case grows for longer; single runs scatter by {float(bands.min()):.1%} to"
        f" {float(bands.max()):.1%} (standard deviation)"
    )
    says = "upper confidence limit of the difference of mean l2, over the scatter of runs"
    return judge(measured, Below(BAND, *over, says=says), caveat)


# --- The abstract ---------------------------------------------------------------------------------


@claim(
    "Abstract; Introduction",
    "The process continues until a dynamical equilibrium is reached where each pendulum oscillates"
    " at a finite amplitude.",
    NEEDS,
    controls=wrong_cases("fig4_small", "fig2_small", "fig2_large", "fig3_small", "fig3_large"),
    on=("fig4_small",),
)
def ensemble_equilibrium(members) -> Finding:
    def least(case):
        amplitudes = pendula(case)
        share = float(case["l2_start"]) / np.sqrt(amplitudes[0].size)
        return amplitudes.min(axis=(1, 2)) / share

    least_of_all = limits(members, "fig4_small", least)
    changes = limits(members, "fig4_small", lambda case: np.square(change(case, "l2") + 1.0) - 1.0)
    lows, moves = named(least_of_all, "low", "least"), named(distance(changes), "high", "change")
    everywhere = Above(
        FACTOR, *lows,
        says=f"lower confidence limit of the least amplitude of all pendula on {LATER}, over that"
        " of the initial power spread evenly",
    )  # fmt: skip
    settled = Below(CHANGE, *moves, says=f"upper confidence limit of the change of P to {LATER}")
    caveat = "only a finite chain reaches equilibrium everywhere; a longer chain takes longer"
    return judge(lows | moves, AllOf(everywhere, settled), caveat)


@claim(
    "Section 5, Fig 4",
    "The transition does not depend on how large the initial amplitude is.",
    checks("lifetimes"),
    controls=(
        Control(
            "the runs in reverse order of their amplitudes",
            exchange("start_amplitude", names=("life", "median")),
        ),
    ),
)
def transition_amplitude(lifetimes) -> Finding:
    """Decide for amplitudes up to the larger one of the paper; what larger ones do is a caveat."""
    lives, a0 = lifetimes["life"].values, lifetimes["start_amplitude"].values
    members, end = lives.shape[1], float(lifetimes["tau"][-1])
    if end < END or share_limits(members, members, LEVEL.value).low <= ALL.value:
        raise UndecidableError(f"the runs are too few for a confidence interval, or end at {end:g}")
    shown = a0 <= PAPERS_LARGEST
    if shown.sum() < 2:
        raise UndecidableError(f"there are fewer than two amplitudes up to {PAPERS_LARGEST:g}")
    shares = [share_limits(int((life <= END).sum()), members, LEVEL.value) for life in lives]
    lows = np.array([share.low for share in shares])
    medians, missed = lifetimes["median"].values[shown], np.flatnonzero(lows <= ALL.value)
    measured = {f"low_{one:g}": low for one, low in zip(a0, lows, strict=True)}
    measured |= {"fastest": medians.min(), "slowest": medians.max()}
    caveat = ", ".join(f"{shares[k].value:.0%} from A_0 = {a0[k]:g}" for k in missed)
    if caveat:
        caveat = f"by tau = {END:g} only part of the runs has made the transition: {caveat}"
    criterion = Above(
        ALL, *(f"low_{one:g}" for one in a0[shown]),
        says=f"lower confidence limit of the share of runs with a transition by tau = {END:g}",
    )  # fmt: skip
    return judge(measured, criterion, caveat)
