"""The paper's claims on chaotic figures against time, decided by ensembles instead of single runs.

A single run is one random sample, and the next may differ. A claim therefore holds if the
confidence limits of its ensemble satisfy the criterion.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import (
    CONFIDENCE,
    ConfidenceInterval,
    difference_limits,
    mean_limits,
)
from replication.ledger.changes import repeat, scale, take
from replication.ledger.claim import ClaimControl, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    UndecidableError,
    WithinFactor,
    judge,
)
from replication.ledger.cutoff import Cutoff, once
from replication.ledger.missing import FEWEST

from pendula.claims import CHANGE, FACTOR, FAR_AS_NEAR, MUCH, SENSITIVITY, almost_equal, checks

from .clocks import limits_of

SECTION = 5
NEEDS = checks("members")
EARLIER, LATER = "[10, 30]", "[30, 50]"
"""The two halves of the time over which the paper takes its statistics."""

LEVEL = Cutoff(CONFIDENCE, "the customary level of confidence, 95 %", 1.0)
BAND = Cutoff(1.0, '"no visible differences": smaller than the band over which runs scatter')
SEVERAL = Cutoff(3.0, '"other pendula": more than three')
MANY = Cutoff(0.25, '"many pendula": a quarter of all')
ANTICORRELATED = Cutoff(
    -0.8, '"mix up": not an exchange, in which |A|^2 and |B|^2 are anticorrelated', -1.0
)

END = 50.0
"""The end time of the paper's Figs 2 to 4."""
PAPERS_LARGEST = 5.0
"""A_0 of the paper's large initial condition."""


@once
def members_of(members: xr.Dataset, case: str) -> xr.Dataset:
    """Return the dataset of the members of a case. Raises UndecidableError if there are too few."""
    if case not in members["case"].values or not {EARLIER, LATER} <= set(members["window"].values):
        raise UndecidableError(f"there is no ensemble of {case} on {EARLIER} and {LATER}")
    if members.sizes["member"] < FEWEST:
        raise UndecidableError(f"the ensemble has fewer than {FEWEST} members")
    return members.sel(case=case)


def mean_limits_of(
    members: xr.Dataset, case: str, reduce: Callable, *arguments: Any
) -> ConfidenceInterval:
    """Return the mean of a number over the members of a case, with confidence limits.

    `reduce` returns the number of each member from the dataset of the case and `arguments`.
    """
    return mean_limits(reduce(members_of(members, case), *arguments), LEVEL.value)


def largest_limit(limit: ConfidenceInterval) -> float:
    """Return the larger modulus of the two limits."""
    return max(abs(limit.low), abs(limit.high))


# Functions that return a number of each member, (member,), from the dataset of a case


@once
def level(case: xr.Dataset, norm: str, window: str = LATER, quantity: str = "pair") -> np.ndarray:
    """Return the mean of a norm over a window, (member,)."""
    return case[f"{norm}_level"].sel(window=window, quantity=quantity).values


def over_start(case: xr.Dataset, norm: str) -> np.ndarray:
    """Return the late mean of a norm divided by its initial value, (member,)."""
    return level(case, norm) / float(case[f"{norm}_start"])


def change(case: xr.Dataset, norm: str) -> np.ndarray:
    """Return the relative change of a norm from the EARLIER to the LATER window, (member,)."""
    return level(case, norm) / level(case, norm, EARLIER) - 1.0


def pendula(case: xr.Dataset) -> np.ndarray:
    """Return the late root mean square amplitudes of all pendula, (member, component, site)."""
    late = case["rms"].sel(window=LATER).dropna("site", how="all")
    return late.transpose("member", "component", "site").values


# --- Wrong cases ----------------------------------------------------------------------------------

WORDS = {
    "fig2_small": "the small case at Omega = 8, which is stable",
    "fig2_large": "the large case at Omega = 8, which is stable",
    "fig3_small": "the small case at Omega = -4, which is stable",
    "fig4_small": "the small case at Omega = 0, which grows",
}


def wrong_case(right: str, wrong: str) -> ClaimControl:
    """Return the control with the members of the case `wrong` in place of those of `right`."""
    fed = {"members": repeat("case", wrong, at=right)}
    return ClaimControl(WORDS[wrong], fed, on=(right, wrong))


# --- Fig 3, lower ---------------------------------------------------------------------------------


def fig3(statement: str, *wrongs: str) -> Callable:
    """Return the decorator of a claim with the members of these other cases as controls.

    The claim also needs the shares of runs that spread; FAR_AS_NEAR is a control for them.
    """
    place, needs = "Section 5, Fig 3 lower, in ensembles", (*NEEDS, SENSITIVITY)
    controls = (*(wrong_case("fig3_large", wrong) for wrong in wrongs), FAR_AS_NEAR)
    return claim(place, statement, needs, controls, ("fig3_large",))


@fig3("As a result, the l2 norm of the solution grows.", "fig3_small")
def ensemble_fig3_grows(members: xr.Dataset, sensitivity: xr.Dataset) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])
    grown = mean_limits_of(members, "fig3_large", over_start, "l2")
    label = f"lower confidence limit of the mean l2 on {LATER} over its initial value"
    return near.judge({"growth": grown.value, "low": grown.low}, Above(FACTOR, "low", label=label))


@fig3(
    "The central pendulum excites large oscillations of other pendula in the chain.", "fig2_large"
)
def ensemble_fig3_excites(members: xr.Dataset, sensitivity: xr.Dataset) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])

    def excited(case: xr.Dataset) -> np.ndarray:
        amplitudes = pendula(case)
        neighbours = np.delete(amplitudes, amplitudes.shape[2] // 2, axis=2)
        return (neighbours > float(case["linf_start"]) / MUCH.value).sum(axis=(1, 2))

    low = mean_limits_of(members, "fig3_large", excited).low
    label = f"lower confidence limit of the number of other pendula above A_0 / 3 on {LATER}"
    return near.judge({"low": low}, Above(SEVERAL, "low", label=label))


@fig3("The A and B modes mix up.", "fig2_large", "fig2_small")
def ensemble_fig3_mixes(members: xr.Dataset, sensitivity: xr.Dataset) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])

    def ratio(case: xr.Dataset) -> np.ndarray:
        return level(case, "l2", LATER, "A") / level(case, "l2", LATER, "B")

    def correlation(case: xr.Dataset) -> np.ndarray:
        return case["norm_correlation"].sel(window=LATER).values

    ratios = mean_limits_of(members, "fig3_large", ratio)
    measured = {"ratio_low": ratios.low, "ratio_high": ratios.high}
    is_comparable = WithinFactor(
        FACTOR, *measured, label="confidence interval of l2 of A over that of B"
    )
    measured["correlation_low"] = mean_limits_of(members, "fig3_large", correlation).low
    label = "lower confidence limit of the correlation of |A|^2 and |B|^2"
    return near.judge(
        measured, is_comparable, Above(ANTICORRELATED, "correlation_low", label=label)
    )


@fig3("The l-infinity norm stays at its initial level.", "fig4_small", "fig2_small")
def ensemble_fig3_maximum(members: xr.Dataset, sensitivity: xr.Dataset) -> Finding:
    near = almost_equal(sensitivity, members.attrs["perturbation"])
    ratio = mean_limits_of(members, "fig3_large", over_start, "linf")
    measured = {"ratio": ratio.value, "low": ratio.low, "high": ratio.high}
    rises = f"it rises by at least {ratio.low - 1.0:.0%}" if ratio.low > 1.0 else ""
    label = f"confidence interval of the mean l-infinity norm on {LATER} over its initial value"
    return near.judge(measured, WithinFactor(FACTOR, "low", "high", label=label), caveat=rises)


# --- Fig 4 ----------------------------------------------------------------------------------------

BOTH = ("fig4_small", "fig4_large")
fig4 = partial(claim, "Section 5, Fig 4, in ensembles", needs=NEEDS, on=BOTH)


def lows(members: xr.Dataset, name: str, reduce: Callable) -> dict[str, float]:
    """Return the lower confidence limits of a number in both cases of Fig 4, by their names."""
    return {f"{case}_{name}_low": mean_limits_of(members, case, reduce).low for case in BOTH}


@fig4(
    "The growth of oscillation amplitudes stabilises at a certain level of the l-infinity norm, and"
    " the l2 norm is significantly larger than the l-infinity norm.",
    controls=(wrong_case("fig4_small", "fig3_small"), wrong_case("fig4_large", "fig2_large")),
)
def ensemble_fig4_settles(members: xr.Dataset) -> Finding:
    changes = {
        f"{case}_change": largest_limit(mean_limits_of(members, case, change, "linf"))
        for case in BOTH
    }
    grown = {"growth_low": mean_limits_of(members, "fig4_small", over_start, "linf").low}
    over = lows(members, "l2_over_linf", lambda case: level(case, "l2") / level(case, "linf"))
    criterion = AllOf(
        Below(CHANGE, *changes, label=f"upper confidence limit of the change to {LATER}"),
        Above(FACTOR, *grown, label="lower confidence limit of the growth in the small case"),
        Above(MUCH, *over, label=f"lower confidence limit of l2 over l-infinity on {LATER}"),
    )
    return judge(changes | grown | over, criterion)


@claim(
    "Section 5, Fig 4",
    "Many pendula oscillate with large and comparable amplitudes with respect to the central one.",
    NEEDS,
    controls=(wrong_case("fig4_large", "fig2_large"), wrong_case("fig4_small", "fig2_small")),
    on=BOTH,
)
def ensemble_fig4_many(members: xr.Dataset) -> Finding:
    def share(case: xr.Dataset) -> np.ndarray:
        amplitudes = pendula(case)
        centre = amplitudes[:, :, amplitudes.shape[2] // 2].max(axis=1)[:, None, None]
        large = amplitudes > float(case["linf_start"]) / MUCH.value
        return ((amplitudes > centre / FACTOR.value) & large).mean(axis=(1, 2))

    measured = lows(members, "share", share)
    label = "lower confidence limit of the share of amplitudes above half of the centre's and A_0/3"
    return judge(measured, Above(MANY, *measured, label=label))


@fig4(
    "There are no visible differences between the upper and lower panels.",
    controls=(
        wrong_case("fig4_small", "fig3_small"),
        ClaimControl(
            "the lower panel in place of the upper one",
            repeat("case", "fig4_large", at="fig4_small"),
            confirms=True,
            on=BOTH,
        ),
    ),
)
def ensemble_fig4_alike(members: xr.Dataset) -> Finding:
    """Compare the difference of both panels' means with the scatter of runs.

    Each panel shows a single run, so only a difference wider than this scatter is visible.
    """
    upper, lower = (members_of(members, case) for case in BOTH)
    small, large = (level(case, "l2") for case in (upper, lower))
    difference = difference_limits(large / large.mean(), small / large.mean(), LEVEL.value)
    band = float(lower["relative_width"])
    measured = {"difference": difference.value, "over_band": largest_limit(difference) / band}
    caveat = (
        f"the means differ by {abs(difference.value):.1%} on {LATER}, and single runs scatter by"
        f" {band:.1%} (standard deviation)"
    )
    label = f"confidence limit of the difference of mean l2 on {LATER}, over the scatter of runs"
    return judge(measured, Below(BAND, "over_band", label=label), caveat)


# --- The abstract ---------------------------------------------------------------------------------


@claim(
    "Abstract; Introduction",
    "The process continues until a dynamical equilibrium is reached where each pendulum oscillates"
    " at a finite amplitude.",
    NEEDS,
    controls=(wrong_case("fig4_small", "fig2_small"),),
    on=("fig4_small",),
)
def ensemble_equilibrium(members: xr.Dataset) -> Finding:
    def least(case: xr.Dataset) -> np.ndarray:
        amplitudes = pendula(case)
        share = float(case["l2_start"]) / np.sqrt(amplitudes[0].size)
        return amplitudes.min(axis=(1, 2)) / share

    def power_change(case: xr.Dataset) -> np.ndarray:
        return np.square(change(case, "l2") + 1.0) - 1.0

    measured = {
        "least_low": mean_limits_of(members, "fig4_small", least).low,
        "change": largest_limit(mean_limits_of(members, "fig4_small", power_change)),
    }
    everywhere = Above(
        FACTOR,
        "least_low",
        label=f"lower confidence limit of the least amplitude of all pendula on {LATER}, over the"
        " amplitude if the initial power were evenly spread",
    )
    settled = Below(CHANGE, "change", label=f"confidence limit of the change of P to {LATER}")
    caveat = "only a finite chain reaches equilibrium everywhere; a longer chain takes longer"
    return judge(measured, AllOf(everywhere, settled), caveat)


def slower_from_one(lifetimes: xr.Dataset) -> xr.Dataset:
    """Return, as a control, the dataset with later transitions from the smallest amplitude."""
    smallest = lifetimes["start_amplitude"].values.min()
    return scale("transition", 2.5, start_amplitude=smallest)(lifetimes)


@claim(
    "Section 5, Fig 4",
    "The transition does not depend on how large the initial amplitude is.",
    checks("lifetimes"),
    controls=(
        ClaimControl("the time at which the central pair calms down", take(transition="life")),
        ClaimControl("runs from one amplitude that take 2.5 times as long", slower_from_one),
    ),
)
def transition_amplitude(lifetimes: xr.Dataset) -> Finding:
    """Require similar transition times and late norms from all amplitudes.

    A centre that stays excited inside the chaotic chain is a caveat.
    """
    a0, end = lifetimes["start_amplitude"].values, float(lifetimes.attrs["window_end"])
    if end < END or a0.size < 2 or a0.min() >= PAPERS_LARGEST or lifetimes.sizes["member"] < FEWEST:
        raise UndecidableError(
            f"at least {FEWEST} members, runs to tau = {END:g} and two amplitudes A_0 are required,"
            f" one of them below {PAPERS_LARGEST:g}"
        )
    limits = limits_of(lifetimes, LEVEL.value)
    times, norms = limits["transition"], limits["l2"]
    measured = {
        "slowest_over_fastest": times.high.max() / times.low.min(),
        "level_range": norms.high.max() / norms.low.min() - 1.0,
        "fastest": times.value.min(),
        "slowest": times.value.max(),
    }
    criterion = AllOf(
        Below(FACTOR, "slowest_over_fastest", label="ratio of confidence limits of median times"),
        Below(CHANGE, "level_range", label="relative difference of confidence limits of late l2"),
    )
    return judge(measured, criterion, excited_centre(lifetimes, limits["centre_share"]))


def excited_centre(lifetimes: xr.Dataset, share: ConfidenceInterval) -> str:
    """Return the caveat that the centre stays excited from some amplitudes, or an empty text."""
    a0, pairs = lifetimes["start_amplitude"].values, 2 * int(lifetimes.attrs["half_width"]) + 1
    excited = a0[share.low > FACTOR.value / pairs]
    if not excited.size:
        return ""
    shares = share.value[np.isin(a0, excited)]
    return (
        f"if A_0 is {excited.min():g} or more, the central pair stays excited inside the chaotic"
        f" chain: it holds {shares.min():.1%} to {shares.max():.1%} of P, the average pair"
        f" {1 / pairs:.1%}"
    )
