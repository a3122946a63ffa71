"""What the paper says of Figs 5 and 6, right, of ensembles at each half-width M.

A single sweep is one draw at each M, and its points scatter by what chaos makes of the last digits.
The means over the ensembles do not, and Student's t says how far they can be trusted. As in
`claims`, a sentence must hold in both kinds of ensembles.
"""

from functools import partial
from typing import NamedTuple

import numpy as np
from latticode.measures.confidence import Limits, ratio_limits, student
from latticode.measures.levels import levelling_of_means

from pendula.ledger.changes import keep, repeat, take
from pendula.ledger.chaos import FAR_AS_NEAR, SENSITIVITY, AlmostEqual, almost_equal
from pendula.ledger.claim import CHANGE, FACTOR, FEWEST, NEARLY_ALL, Control, checks, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    NeverLevels,
    UndecidableError,
    judge,
)
from pendula.ledger.cutoff import Cutoff, once
from pendula.many_cases import constants_of
from pendula.models.bounds import theorem_2_constants

from .claims import LEVEL

SECTION = 5
SAME = Cutoff(
    0.9973,
    "three standard errors, which the means of one law exceed a few times in a thousand",
    1.0,
)
NEEDS = checks("ensembles", "ensembles_uneven")
TEXT_5, TEXT_6 = "[10, 50]", "[10, 70]"
"""The windows of the maxima in the text."""
PARTS = 3
"""Half-widths make so many groups, of short, middle and long chains; fewer show no return."""


class Means(NamedTuple):
    """Means over the members at each half-width, and their standard errors, all (half_width,)."""

    half_width: np.ndarray
    mean: np.ndarray
    error: np.ndarray
    members: int

    @property
    def off(self) -> np.ndarray:
        """Half of each confidence interval."""
        return student(self.members - 1, LEVEL.value) * self.error

    @property
    def apart(self) -> float:
        """How many standard errors two means must differ by, to differ at all."""
        return student(2 * (self.members - 1), LEVEL.value)

    def level_from(self, least: int) -> float:
        """Return the half-width from which at least so many means are the same."""
        noise = student(2 * (self.members - 1), SAME.value)
        return levelling_of_means(self.half_width, self.mean, self.error, noise, least)


@once
def maxima(ensembles, sweep: str, norm: str, window: str) -> Means:
    """Return the means of the maxima of the pair's norm over a window."""
    text = f"the ensemble has fewer than {FEWEST} half-widths, or not the window"
    if window not in ensembles["window"].values:
        raise UndecidableError(text)
    chosen = {"sweep": sweep, "quantity": "pair", "statistic": "max", "window": window}
    kept = ensembles.sel(chosen).dropna("half_width", subset=[f"{norm}_mean"])
    if kept.sizes["half_width"] < FEWEST:
        raise UndecidableError(text)
    values = (kept[name].values for name in ("half_width", f"{norm}_mean", f"{norm}_error"))
    return Means(*values, int(kept["swept_members"]))


def both(even, uneven, sweep: str, norm: str, window: str) -> dict[str, Means]:
    """Return the means of both kinds of ensembles."""
    kinds = {"even": even, "uneven": uneven}
    return {kind: maxima(data, sweep, norm, window) for kind, data in kinds.items()}


def over(means: Means, below: slice, above: slice) -> Limits:
    """Return the mean over some half-widths over that of others, `above` / `below`."""
    value = [means.mean[part].mean() for part in (below, above)]
    errors = [means.error[part] for part in (below, above)]
    error = [np.sqrt((one**2).sum()) / len(one) for one in errors]
    return ratio_limits(value, error, means.members, LEVEL.value)


def growth_and_levels(found: dict[str, Means]) -> tuple[dict[str, float], dict[str, float]]:
    """Return the lower limit of the longest chain over the shortest, and where each kind levels."""
    growth = {
        f"{kind}_growth_low": over(means, slice(1), slice(-1, None)).low
        for kind, means in found.items()
    }
    return growth, {f"{kind}_level_from": one.level_from(least=2) for kind, one in found.items()}


# --- Wrong cases ----------------------------------------------------------------------------------


def with_sweep(name: str):
    """Return a function of an ensemble and a sweep: the sweep's maxima in place of those means.

    The runs of a stable case are all alike, so that their means have no error.
    """

    def change(ensembles, sweep):
        own = sweep["l2"].sel(half_width=ensembles["half_width"]).transpose(
            *ensembles["l2_mean"].dims[1:]
        )  # fmt: skip
        right = ensembles["sweep"] == name
        return ensembles.assign(
            l2_mean=ensembles["l2_mean"].where(~right, own),
            l2_error=ensembles["l2_error"].where(~right, 0.0),
        )

    return change


STABLE = {"fig5_left": "the small case at Omega = -4", "fig6_left": "the large case at Omega = 8"}


def stable(right: str, *wrongs: str) -> tuple[Control, ...]:
    """Return controls: single sweeps of stable cases, which have nothing to scatter."""
    return tuple(
        Control(STABLE[name], {NEEDS[0]: (f"sweeps/{name}", with_sweep(right))}) for name in wrongs
    )


CROSSED = keep(half_width=slice(None, 100))
"""Chains that the front still crosses by the end."""


# --- Fig 5, right ---------------------------------------------------------------------------------

fig5 = partial(claim, "Section 5, Fig 5 right, in ensembles", needs=NEEDS, on=("fig5_right",))


@fig5(
    "The maximal l2 norm grows nearly monotonically with M at Omega = 0.",
    controls=(
        *stable("fig5_right", "fig5_left", "fig6_left"),
        Control(
            "the large case at Omega = -4, whose norm falls again",
            {"ensembles": repeat("sweep", "fig6_right", at="fig5_right")},
            on=("fig5_right", "fig6_right"),
        ),
    ),
)
def ensemble_fig5_grows(even, uneven) -> Finding:
    found = both(even, uneven, "fig5_right", "l2", TEXT_5)
    growth, levels = growth_and_levels(found)
    rising = {}
    for kind, means in found.items():
        noise = means.apart * np.sqrt(means.error[1:] ** 2 + means.error[:-1] ** 2)
        rising[f"{kind}_rising"] = np.mean(np.diff(means.mean) > noise)
    first = min(levels.values())
    caveat = f"up to M = {first:.0f}, where it levels off" if np.isfinite(first) else ""
    criterion = AllOf(
        Above(FACTOR, *growth, says="lower confidence limit of longest over shortest chain"),
        Above(NEARLY_ALL, *rising, says="share of steps in M with a significant rise"),
    )
    return judge(growth | rising | {"level_from": first}, criterion, caveat)


@fig5(
    "The growth with M confirms growth on the unbounded lattice as time goes to infinity.",
    controls=(
        *stable("fig5_right", "fig6_left", "fig5_left"),
        Control(
            "only chains whose ends the front reaches, so that the norm does not level off",
            dict.fromkeys(NEEDS, CROSSED),
            confirms=True,
        ),
    ),
)
def ensemble_fig5_conjecture(even, uneven) -> Finding:
    found = both(even, uneven, "fig5_right", "l2", TEXT_5)
    growth, levels = growth_and_levels(found)
    grows = Above(1.0, *growth, says="lower confidence limit of longest over shortest chain")
    criterion, measured = AllOf(grows, NeverLevels(*levels)), growth | levels
    seen = [level for level in levels.values() if np.isfinite(level)]
    fails = ""
    if grows.holds(measured) and seen:
        fails = (
            f"in a fixed time window the ensemble mean of l2 is level from M = {max(seen):.0f} on, "
            "so its growth with M does not show growth in time"
        )
    longest = found["even"].half_width[-1]
    caveat = f"in a fixed time window, and on chains up to M = {longest:.0f}"
    return judge(measured, criterion, caveat, fails)


@fig5(
    "The l-infinity norm saturates to the same level independently of M.",
    controls=(
        Control(
            "the l2 norm, which grows with M",
            {"ensembles": take(linf_mean="l2_mean", linf_error="l2_error")},
        ),
    ),
)
def ensemble_fig5_maximum(even, uneven) -> Finding:
    """Ask whether short, middle and long chains have the same level.

    The range over single half-widths is mostly that of their errors, and grows with their number.
    """
    measured = {}
    for kind, means in both(even, uneven, "fig5_right", "linf", TEXT_5).items():
        parts = np.array_split(np.arange(len(means.mean)), PARTS)
        levels = np.array([means.mean[part].mean() for part in parts])
        off = np.array([np.sqrt(np.sum(means.off[part] ** 2)) / len(part) for part in parts])
        measured[f"{kind}_range"] = ((levels + off).max() - (levels - off).min()) / levels.mean()
    says = "range of the confidence intervals on short, middle and long chains, over the mean"
    return judge(measured, Below(CHANGE, *measured, says=says))


# --- Fig 6, right ---------------------------------------------------------------------------------


def fig6(says: str, *on: str, place: str = "Section 5, Fig 6 right, in ensembles"):
    """Return the decorator of a claim that needs the shares of runs that spread as well.

    Its controls are sweeps of stable cases, and shares that do not spread close to the data.
    """
    controls = (*stable("fig6_right", "fig6_left", "fig5_left"), FAR_AS_NEAR)
    return claim(place, says, (*NEEDS, SENSITIVITY), controls, (*on, "fig6_right"))


def nearest(even, uneven, sensitivity) -> AlmostEqual:
    """Return what the shares that spread say of both kinds of ensembles."""
    return almost_equal(sensitivity, max(even.attrs["perturbation"], uneven.attrs["perturbation"]))


@fig6("At Omega = -4 and from the large initial condition the maximal l2 norm grows with M.")
def ensemble_fig6_grows(even, uneven, sensitivity) -> Finding:
    near = nearest(even, uneven, sensitivity)
    measured, lows, peaks, back = {}, {}, [], []
    for kind, means in both(even, uneven, "fig6_right", "l2", TEXT_6).items():
        ratio, peak = over(means, slice(1), slice(1, None)), int(np.argmax(means.mean))
        peaks.append(means.half_width[peak])
        measured |= {f"{kind}_ratio": ratio.value, f"{kind}_high": ratio.high}
        measured[f"{kind}_peak_at"], lows[f"{kind}_low"] = peaks[-1], ratio.low
        back.append(over(means, slice(peak, peak + 1), slice(-3, None)).value)
    peak = (
        f"up to M = {max(peaks):.0f}; on the three longest chains it is {min(back):.2f} to"
        f" {max(back):.2f} of the peak"
    )
    says = "lower confidence limit of the mean on all longer chains over that on the shortest"
    return near.judge(measured | lows, Above(1.0, *lows, says=says), caveat=peak)


@claim(
    "Section 5, Fig 6 right, in ensembles",
    "It apparently diverges as N goes to infinity.",
    NEEDS,
    controls=(
        Control(
            "Omega = 0 on chains whose ends the front reaches",
            dict.fromkeys(
                NEEDS, lambda data: repeat("sweep", "fig5_right", at="fig6_right")(CROSSED(data))
            ),
            confirms=True,
            on=("fig5_right",),
        ),
    ),
    on=("fig6_right",),
)
def ensemble_fig6_diverges(even, uneven) -> Finding:
    measured, levels = {}, {}
    for kind, means in both(even, uneven, "fig6_right", "l2", TEXT_6).items():
        levels[f"{kind}_level_from"] = measured[f"{kind}_level_from"] = means.level_from(least=3)
        measured |= {f"{kind}_last": means.mean[-1], f"{kind}_off": means.off[-1]}
    found = [level for level in levels.values() if np.isfinite(level)]
    of = "" if len(found) == len(levels) else " of one kind"
    fails = (
        f"from M = {max(found, default=np.nan):.0f} on the ensemble means{of} agree within their"
        " confidence intervals, because the front does not reach the ends"
    )
    return judge(measured, NeverLevels(*levels), fails=fails)


@fig6(
    "The limitation of Theorem 2 to small initial conditions is not a technical shortfall.",
    "fig3_large",
)
def ensemble_fig6_not_technical(even, uneven, sensitivity) -> Finding:
    near = nearest(even, uneven, sensitivity)
    c_0 = theorem_2_constants(constants_of(even, "fig3_large"))[1]
    start = np.square(float(even["l2"].sel(case="fig3_large", quantity="pair", quantile=0.5)[0]))
    lows = {
        f"{kind}_low": np.square(means.mean[-1] - means.off[-1]) / start
        for kind, means in both(even, uneven, "fig6_right", "l2", TEXT_6).items()
    }
    fixed = "a fixed time window cannot show growth without bound"
    says = "lower confidence limit of the largest P over its initial value"
    return near.judge(lows | {"C_0": c_0}, Above(c_0, *lows, says=says), caveat=fixed)


@fig6(
    "The time span [10, 70] gives the oscillations enough time to be excited in the chain.",
    "fig3_large",
    place="Section 5, Fig 6, in ensembles",
)
def ensemble_fig6_time(even, uneven, sensitivity) -> Finding:
    near = nearest(even, uneven, sensitivity)
    start = float(even["l2"].sel(case="fig3_large", quantity="pair", quantile=0.5)[0])
    lows, shorter = {}, []
    before = both(even, uneven, "fig6_right", "l2", TEXT_5)
    for kind, means in both(even, uneven, "fig6_right", "l2", TEXT_6).items():
        lows[f"{kind}_low"] = (means.mean - means.off).min() / start
        shorter.append(before[kind].mean[-1] / means.mean[-1])
    measured = lows | {"shorter_over_longer": min(shorter)}
    earlier = (
        f"the shorter span {TEXT_5} is enough too: on the longest chain it gives"
        f" {min(shorter):.0%} of the norm"
    )
    says = "lower confidence limit of l2 over its initial value, at every M"
    return near.judge(measured, Above(FACTOR, *lows, says=says), caveat=earlier)
