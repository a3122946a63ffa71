"""The paper's claims on Figs 5 and 6, right, decided by ensembles at each half-width M.

A single sweep is one random sample at each M: chaos amplifies rounding errors, and its points
scatter. Means over ensembles scatter less, and Student's t gives their confidence intervals.

In a fixed time window no norm can diverge with M: by (19) the norm on the infinite chain is finite,
and the norm on a chain equals it if the front does not reach the ends within the window. A sweep
can therefore show growth with M, but neither growth in time nor divergence with M.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
import xarray as xr
from latticode.measures.confidence import ConfidenceInterval, ratio_limits, student
from latticode.measures.levels import relative_range
from latticode.measures.norms import total_power
from replication.ledger.chances import RARE
from replication.ledger.changes import keep, repeat, scale, take, take_from
from replication.ledger.claim import ClaimControl, Kind, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    Near,
    UndecidableError,
    judge,
    undecided,
)
from replication.ledger.cutoff import once

from pendula.claims import (
    CHANGE,
    CONSTANT,
    FACTOR,
    FAR_AS_NEAR,
    FEWEST,
    NEARLY_ALL,
    SENSITIVITY,
    almost_equal,
    checks,
    runs,
    sweeps,
    swept,
)
from pendula.models.bounds import theorem_2_constants
from pendula.problem import Constants

from .claims import LEVEL

SECTION = 5
NEEDS = checks("ensembles")
CASE = runs("fig3_large")
DATA_POWER = 26.0
"""P of the paper's large initial condition, A_0 = 5 and B_0 = 1."""
TEXT_5 = "[10, 50]"
"""The time window of the maxima in Fig 5, in the text."""
READINGS_6 = {"text": ("max", "[10, 70]"), "caption": ("mean", "[10, 40]")}
"""The statistic and the time window of Fig 6, in the text and in the caption."""


class Means(NamedTuple):
    """Means over the members at each half-width and their standard errors, (half_width,)."""

    half_width: np.ndarray
    mean: np.ndarray
    error: np.ndarray
    members: int

    @property
    def half_interval(self) -> np.ndarray:
        """Half of the confidence interval of each mean, (half_width,)."""
        return student(self.members - 1, LEVEL.value) * self.error

    def over(
        self, below: slice, above: slice, confidence: float | None = None
    ) -> ConfidenceInterval:
        """Return a ratio of means over half-widths, `above` divided by `below`, with limits."""
        value = [self.mean[half_widths].mean() for half_widths in (below, above)]
        errors = [self.error[half_widths] for half_widths in (below, above)]
        error = [np.sqrt((each**2).sum()) / len(each) for each in errors]
        return ratio_limits(value, error, self.members, confidence or LEVEL.value)

    @property
    def largest_before(self) -> int:
        """Index of the largest mean on all chains but the longest."""
        return int(np.argmax(self.mean[:-1]))

    def last_growth(self) -> ConfidenceInterval:
        """Return the ratio of the last mean to the largest before it, with wide limits."""
        before = self.largest_before
        return self.over(slice(before, before + 1), slice(-1, None), 1.0 - RARE.value)


@once
def means_of(ensembles: xr.Dataset, sweep: str, norm: str = "l2", reading: str = "text") -> Means:
    """Return the ensemble means of a norm of the pair in a sweep.

    The norm is the maximum over its window if `reading` is "text", the average if it is "caption".
    Raises UndecidableError if there are too few half-widths.
    """
    if sweep not in ensembles["sweep"].values:
        raise UndecidableError(f"there is no ensemble of {sweep}")
    norms = ensembles.sel(sweep=sweep, reading=reading).dropna("half_width", subset=["l2_mean"])
    if norms.sizes["half_width"] < FEWEST:
        raise UndecidableError(f"the ensemble has fewer than {FEWEST} half-widths")
    values = (norms[name].values for name in ("half_width", f"{norm}_mean", f"{norm}_error"))
    return Means(*values, int(norms["swept_members"]))


# --- Wrong cases ----------------------------------------------------------------------------------


def flat(name: str) -> ClaimControl:
    """Return the control with all means of l2 in a sweep equal to the mean on its shortest chain.

    Their relative errors stay the same.
    """

    def changed(ensembles: xr.Dataset) -> xr.Dataset:
        to_shortest = ensembles["l2_mean"].isel(half_width=0) / ensembles["l2_mean"]
        return scale(("l2_mean", "l2_error"), to_shortest, sweep=name)(ensembles)

    return ClaimControl("means that do not depend on M", {NEEDS[0]: changed})


def at_the_start(ensembles: xr.Dataset) -> xr.Dataset:
    """Return, as a control, ensembles with all means at the initial norm of the large data."""
    to_start = np.sqrt(DATA_POWER) / ensembles["l2_mean"]
    return scale("l2_mean", to_start, sweep="fig6_right")(ensembles)


SMALL = ClaimControl("means that stay at the initial norm", {NEEDS[0]: at_the_start})
CROSSED = keep(half_width=slice(None, 100))
"""Keep the chains with ends that the front reaches within the time window."""


# --- Fig 5, right ---------------------------------------------------------------------------------

fig5 = partial(claim, "Section 5, Fig 5 right, in ensembles", needs=NEEDS, on=("fig5_right",))


@fig5(
    "The maximal l2 norm grows nearly monotonically with M at Omega = 0.",
    controls=(flat("fig5_right"),),
)
def ensemble_fig5_grows(ensembles: xr.Dataset) -> Finding:
    means = means_of(ensembles, "fig5_right")
    quantile = student(2 * (means.members - 1), LEVEL.value)
    noise = quantile * np.sqrt(means.error[1:] ** 2 + means.error[:-1] ** 2)
    growth, last = means.over(slice(1), slice(-1, None)), means.last_growth()
    measured = {
        "growth": growth.value,
        "growth_low": growth.low,
        "rising": np.mean(np.diff(means.mean) > noise),
        "largest_at": means.half_width[means.largest_before],
    }
    criterion = AllOf(
        Above(FACTOR, "growth_low", label="lower confidence limit of longest over shortest chain"),
        Above(NEARLY_ALL, "rising", label="share of steps in M with a significant rise"),
    )
    levels = f"up to M = {measured['largest_at']:g}, where it levels off"
    return judge(measured, criterion, levels if last.low <= 1.0 else "")


STILL_GROWS = Above(
    1.0, "last_growth_low", label="lower confidence limit of the longest over any shorter chain"
)


def last_growth_of(means: Means) -> dict[str, float]:
    """Return the measured numbers of the growth to the longest chain."""
    last = means.last_growth()
    return {
        "last_growth": last.value,
        "last_growth_low": last.low,
        "longest": means.half_width[-1],
        "largest_at": means.half_width[means.largest_before],
    }


def explain_no_growth(means: Means) -> str:
    """Return a clause that explains why a sweep levels off."""
    last, longest = means.last_growth(), means.half_width[-1]
    largest = means.half_width[means.largest_before]
    return (
        f"the ensemble mean at M = {longest:g} is {last.value:.2f} times the largest of shorter"
        f" chains, at M = {largest:g}: the front does not reach the ends of long chains within the"
        " time window, and by (19) the norm on the infinite chain is finite in any such window"
    )


@fig5(
    "The growth with M confirms growth on the unbounded lattice as time goes to infinity.",
    controls=(
        flat("fig5_right"),
        ClaimControl(
            "only chains whose ends the front reaches, so that the norm does not level off",
            CROSSED,
            confirms=True,
        ),
    ),
    kind=Kind.CONCLUSION,
)
def ensemble_fig5_conjecture(ensembles: xr.Dataset) -> Finding:
    """Require that the norm still grows on the longest chains."""
    means = means_of(ensembles, "fig5_right")
    measured = {"growth_low": means.over(slice(1), slice(-1, None)).low, **last_growth_of(means)}
    label = "lower confidence limit of longest over shortest chain"
    grows, fails = Above(1.0, "growth_low", label=label), ""
    if grows.holds(measured):
        fails = (
            f"growth with M is not growth in time: {explain_no_growth(means)}; whether the norm"
            " grows in time is decided on the infinite chain"
        )
    caveat = f"in a fixed time window, and on chains up to M = {means.half_width[-1]:.0f}"
    return judge(measured, AllOf(grows, STILL_GROWS), caveat, fails)


@fig5(
    "The l-infinity norm saturates to the same level independently of M.",
    controls=(
        ClaimControl("the l2 norm, which grows", take(linf_mean="l2_mean", linf_error="l2_error")),
    ),
)
def ensemble_fig5_maximum(ensembles: xr.Dataset) -> Finding:
    """Compare long chains with short ones, because single means are too uncertain."""
    means = means_of(ensembles, "fig5_right", "linf")
    half = len(means.mean) // 2
    ratio = means.over(slice(half), slice(half, None))
    label = "confidence interval of the mean on long chains over that on short ones"
    return judge(
        {"low": ratio.low, "high": ratio.high}, Near(1.0, CHANGE, "low", "high", label=label)
    )


# --- Fig 6, right ---------------------------------------------------------------------------------


def fig6(
    statement: str,
    *more_needs: str,
    wrong: ClaimControl,
    place: str = "Section 5, Fig 6 right, in ensembles",
) -> Callable:
    """Return the decorator of a claim that also needs the shares of runs that spread.

    Its controls are `wrong` and FAR_AS_NEAR.
    """
    controls = (wrong, FAR_AS_NEAR)
    return claim(place, statement, (*NEEDS, SENSITIVITY, *more_needs), controls, ("fig6_right",))


@fig6(
    "At Omega = -4 and from the large initial condition the maximal l2 norm grows with M.",
    wrong=flat("fig6_right"),
)
def ensemble_fig6_grows(ensembles: xr.Dataset, sensitivity: xr.Dataset) -> Finding:
    near = almost_equal(sensitivity, ensembles.attrs["perturbation"])
    means = means_of(ensembles, "fig6_right")
    ratio, peak = means.over(slice(1), slice(1, None)), int(np.argmax(means.mean))
    measured = {"ratio": ratio.value, "low": ratio.low, "peak_at": means.half_width[peak]}
    back = means.over(slice(peak, peak + 1), slice(-3, None)).value
    caveat = (
        f"up to M = {measured['peak_at']:.0f}; on the three longest chains it is {back:.2f} of the"
        " peak"
    )
    label = "lower confidence limit of the mean on all longer chains over that on the shortest"
    return near.judge(measured, Above(1.0, "low", label=label), caveat=caveat)


@claim(
    "Section 5, Fig 6 right, in ensembles",
    "It apparently diverges as N goes to infinity.",
    NEEDS,
    controls=(
        ClaimControl(
            "Omega = 0 on chains whose ends the front reaches",
            lambda data: repeat("sweep", "fig5_right", at="fig6_right")(CROSSED(data)),
            confirms=True,
            on=("fig5_right",),
        ),
    ),
    on=("fig6_right",),
    kind=Kind.CONCLUSION,
)
def ensemble_fig6_diverges(ensembles: xr.Dataset) -> Finding:
    """Require that the norm still grows on the longest chains."""
    means = means_of(ensembles, "fig6_right")
    fails = (
        "no sweep over a fixed time window can show divergence, however long its chains:"
        f" {explain_no_growth(means)}; the paper does not give its largest M"
    )
    return judge(last_growth_of(means), STILL_GROWS, fails=fails)


@fig6(
    "The limitation of Theorem 2 to small initial conditions is not a technical shortfall.",
    *CASE,
    wrong=SMALL,
)
def ensemble_fig6_not_technical(
    ensembles: xr.Dataset, sensitivity: xr.Dataset, run: xr.Dataset
) -> Finding:
    near = almost_equal(sensitivity, ensembles.attrs["perturbation"])
    c_0 = theorem_2_constants(Constants.of(run.attrs))[1]
    means = means_of(ensembles, "fig6_right")
    low = np.square(means.mean[-1] - means.half_interval[-1]) / total_power(run)[0]
    fixed = "a fixed time window cannot show growth without bound"
    label = "lower confidence limit of the largest P over its initial value"
    return near.judge({"low": low, "C_0": c_0}, Above(c_0, "low", label=label), caveat=fixed)


@fig6(
    "The time span [10, 70] gives the oscillations enough time to be excited in the chain.",
    *CASE,
    wrong=SMALL,
    place="Section 5, Fig 6, in ensembles",
)
def ensemble_fig6_time(ensembles: xr.Dataset, sensitivity: xr.Dataset, run: xr.Dataset) -> Finding:
    near = almost_equal(sensitivity, ensembles.attrs["perturbation"])
    means = means_of(ensembles, "fig6_right")
    measured = {"low": (means.mean - means.half_interval).min() / np.sqrt(total_power(run)[0])}
    label = "lower confidence limit of l2 over its initial value, at every M"
    return near.judge(measured, Above(FACTOR, "low", label=label))


@claim(
    "Fig 6, caption",
    "The norms shown are averages over [10, 40].",
    (*sweeps("fig6_left"), *checks("ensembles")),
    controls=(
        ClaimControl(
            "averages that grow on the left",
            {"fig6_left": ("fig6_right", take_from("l2", statistic="mean"))},
        ),
    ),
    on=("fig6_left", "fig6_right"),
)
def fig6_caption(left: xr.Dataset, ensembles: xr.Dataset) -> Finding:
    """Require that l2 is constant on the left and grows on the right, by the caption only."""
    measured, criteria = {}, {}
    for reading, quantity in READINGS_6.items():
        right = means_of(ensembles, "fig6_right", "l2", reading)
        measured[f"range_by_{reading}"] = relative_range(swept(left, "l2", *quantity)[1])
        measured[f"low_by_{reading}"] = right.over(slice(1), slice(1, None)).low
        criteria[reading] = AllOf(
            Below(CONSTANT, f"range_by_{reading}", label="range on the left over its mean"),
            Above(1.0, f"low_by_{reading}", label="lower confidence limit of growth on the right"),
        )
    if criteria["text"].holds(measured) == criteria["caption"].holds(measured):
        why = "the figure agrees with the text by both readings, or by neither"
        return undecided(measured, why, AllOf(*criteria.values()))
    return judge(measured, criteria["caption"])
