"""What moves on chains without ends: the front, the bulk behind it, and its largest amplitude."""

from collections.abc import Callable

import numpy as np

from pendula.ledger.almost_equal import FAR_AS_NEAR, SENSITIVITY, almost_equal
from pendula.ledger.claim import FACTOR, SETTLED, Control, claim, unbounded
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    WithinFactor,
    in_words,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff
from pendula.measures.confidence import mean_limits
from pendula.measures.difference import VISIBLE
from pendula.measures.laws import Fitted, best, compare, span_means
from pendula.numerics.elementary import exp, log

from .bulk import end_of_bulk, tail_scale
from .claims import SURE, curves_of, times_of
from .front import FRONT, resolution, speeds

SECTION = 5

RESOLVED = Cutoff(1.0, "a front lies between two sites: half a site either way over the fit's time")
NO_SUPPORT = Cutoff(10.0, "Akaike's criterion: a law that is 10 above another has no support")
HALF_OF_THEM = Cutoff(0.5, '"many": more than half of the sites that the front has passed', 1.0)
SEEN = Cutoff(VISIBLE, "the visible fraction of full scale, about a line's width")
BEGIN = Cutoff(SETTLED, "where laws of the maximum begin: the paper's time windows, at tau = 10")
FAR_AHEAD = 1e6
"""The tau at which the laws of the maximum say what they predict."""

OMEGAS, MAIN = "unbounded/omegas", "unbounded/fig4_small"


def another_omega(run):
    """Return the run with the speeds that are predicted at its next Omega."""
    return run.assign(predicted_speed=run["predicted_speed"].roll(variant=1))


def a_stop(run):
    """Return the run with fronts that stop at half the time."""
    tau = run["piece_tau"]
    middle = run["front"].sel(piece_tau=0.5 * float(tau[-1]), method="nearest")
    return run.assign(front=run["front"].where(tau < 0.5 * tau[-1], middle))


@claim(
    "Introduction",
    "The central pendulum excites its neighbours, and this process continues.",
    unbounded("omegas"),
    (
        Control("the speed of linear spreading at another Omega", {OMEGAS: another_omega}),
        Control("fronts that stop", {OMEGAS: a_stop}),
        Control("small data at Omega = -4", {OMEGAS: "unbounded/fig3_small"}),
        Control("large data at Omega = 8", {OMEGAS: "unbounded/fig2_large"}),
    ),
)
def unbounded_front(run) -> Finding:
    times_of(run)
    found, _ = speeds(run, corrected=True)
    off = np.abs(found - run["predicted_speed"].values)
    known = resolution(run["piece_tau"].values)
    measured = {
        "furthest": off.max(),
        "resolution": known,
        "furthest_over_resolution": off.max() / known,
        "values": len(found),
    }
    says = "largest difference of the speed from that of linear spreading, over its resolution"
    fails = "no front moves on at the speed of linear spreading"
    return judge(measured, AtMost(RESOLVED, "furthest_over_resolution", says=says), fails=fails)


# --- The largest amplitude ------------------------------------------------------------------------


def without_its_rise(run):
    """Return the run with the rise of l-infinity taken off: what is left has a bound."""
    means = span_means(run["tau"].values, curves_of(run, "linf"), BEGIN.value)
    rise = compare(means)[1]["log_tau"].slope.value * log(run["tau"].values.clip(min=1.0))
    return run.assign(linf=run["linf"] - rise)


def towards_a_limit(run, way: Callable = lambda tau: 1.0 / np.sqrt(tau)):
    """Return the run with l-infinity on its `way` to a limit, with its scatter."""
    scatter = run["linf"] - run["linf"].mean("member")
    return run.assign(linf=scatter + 6.0 - 4.0 * way(run["tau"].clip(min=1.0)))


def soon_at_a_limit(run):
    """Return the run with l-infinity on its way to a limit by a law that is none of the fitted."""
    return towards_a_limit(run, lambda tau: exp(-tau / 30.0))


def at_last_at_a_limit(run):
    """Return the run with l-infinity on its way to a limit that is far ahead."""
    return towards_a_limit(run, lambda tau: 1.0 / (1.0 + log(tau)))


def of_the_other_norm(run):
    """Return the run with l2, which has no bound, in place of l-infinity."""
    return run.assign(linf=run["l2"])


@claim(
    "Introduction",
    "The l-infinity norm remains finite at the dynamical equilibrium.",
    unbounded("fig4_small"),
    (
        Control("l2, which grows as the root of tau, in its place", {MAIN: of_the_other_norm}),
        Control("the same scatter without the rise", {MAIN: without_its_rise}, confirms=True),
        Control("the same scatter about a limit", {MAIN: towards_a_limit}, confirms=True),
        Control("a limit approached as exp(-tau / 30)", {MAIN: soon_at_a_limit}, confirms=True),
        Control(
            "a limit approached as 1 / (1 + ln tau): slow bounds look like growth",
            {MAIN: at_last_at_a_limit},
            undecided=True,
        ),
        Control("small data at Omega = -4", {MAIN: "unbounded/amplitudes"}, confirms=True),
    ),
)
def unbounded_maximum(run) -> Finding:
    """Compare bounded laws of l-infinity with growing ones.

    "Remains finite" is read as: stays below a bound for all times. At any one time and on any one
    site the amplitude is finite, which is no finding. Not reproduced: no bounded law has support.
    Confirmed: no growing law that rises has. Where both kinds have, nothing is decided.
    """
    tau, linf = times_of(run), curves_of(run, "linf")
    if len(linf) < 2:
        raise UndecidableError("one run shows no scatter to judge the laws by")
    means = span_means(tau, linf, BEGIN.value)
    bounded, growing = compare(means)
    rise = growing["fourth_root_of_log_tau"].slope
    tails = [tail_scale(state, end_of_bulk(state)) for state in run["state"].isel(variant=0).values]
    tail = mean_limits(tails, SURE.value)
    left = supported(bounded, growing)
    rising = [name for name in left if name in growing]
    measured = {
        "bounded_over_growing": bounded[best(bounded)].criterion - growing[best(growing)].criterion,
        "growing_laws_left": len(rising),
        **{f"{name}_chi2": fit.chi2 for name, fit in {**bounded, **growing}.items()},
        **{f"{name}_at_1e6": fit.at(FAR_AHEAD) for name, fit in {**bounded, **growing}.items()},
        "spans": len(means.values),
        "neighbours": means.neighbours,
        "rise_of_fourth_power": rise.value,
        "rise_error": rise.half,
        "scale_of_the_tail": tail.value,
        "scale_error": tail.half,
        "last": linf[:, -1].mean(),
    }
    if rising and len(left) > len(rising):
        return undecided(measured, _both_fit(left, bounded))
    ahead = ", ".join(f"{fit.at(FAR_AHEAD):.2f} by {in_words(name)}" for name, fit in left.items())
    fails = f"no bounded law that was tried fits; those that fit lead at tau = 1e6 to {ahead}"
    says = "Akaike's criterion of the best bounded law less that of the best growing one"
    criterion = AllOf(
        AtMost(NO_SUPPORT, "bounded_over_growing", says=says),
        AtMost(0.0, "growing_laws_left", says="growing laws that fit and rise"),
    )
    return judge(measured, criterion, fails=fails)


def _both_fit(left: dict[str, Fitted], bounded: dict[str, Fitted]) -> str:
    """Say which bounded laws fit as growing ones do, and how little all differ far ahead."""
    ahead = sorted(fit.at(FAR_AHEAD) for fit in left.values())
    limits = ", ".join(in_words(name) for name in left if name in bounded)
    return (
        f"bounded laws ({limits}) fit as growing ones do, and at tau = 1e6 all of them lead to "
        f"{ahead[0]:.2f} to {ahead[-1]:.2f}: no figure could show the difference"
    )


def supported(bounded: dict[str, Fitted], growing: dict[str, Fitted]) -> dict[str, Fitted]:
    """Return the laws that have support beside the best of all; a growing one has to rise too."""
    laws = {**bounded, **growing}
    least = laws[best(laws)].criterion + NO_SUPPORT.value
    return {
        name: fit
        for name, fit in laws.items()
        if fit.criterion <= least and (name in bounded or fit.slope.low > 0.0)
    }


@claim(
    "Section 5, Fig 3 lower, without ends",
    "The l-infinity norm stays at the level of the initial data.",
    (*unbounded("fig3_large"), SENSITIVITY),
    (
        Control(
            "small data at Omega = 0, where it grows sixfold",
            {"unbounded/fig3_large": "unbounded/fig4_small"},
        ),
        Control(
            "small data at Omega = -4, which disperse",
            {"unbounded/fig3_large": "unbounded/fig3_small"},
        ),
        FAR_AS_NEAR,
    ),
)
def unbounded_large_maximum(run, sensitivity) -> Finding:
    near = almost_equal(sensitivity, run.attrs["perturbation"])
    tau, linf = times_of(run), curves_of(run, "linf")
    late = linf[:, tau >= SETTLED]
    means = mean_limits(late.mean(axis=1) / linf[:, 0], SURE.value)
    measured = {
        "mean_over_initial": means.value,
        "mean_over_initial_at_most": means.high,
        "mean_over_initial_at_least": means.low,
        "largest_over_initial": (late.max(axis=1) / linf[:, 0]).max(),
        "end": tau[-1],
    }
    names = ("mean_over_initial_at_most", "mean_over_initial_at_least")
    says = "limits of the mean since tau = 10 over the initial value"
    criterion = AllOf(WithinFactor(FACTOR, *names, says=says), near.criterion)
    return judge(measured | near.measured, criterion, near.caveat)


# --- The bulk -------------------------------------------------------------------------------------


def largest_ones(_, amplitudes):
    """Return of the runs over amplitudes those from the largest one."""
    return amplitudes.isel(variant=[int(amplitudes["central_modulus"].values.argmax())])


CENTRE = 8
"""Sites about the centre, on each side, whose mean stands for the central pendulum's amplitude."""


@claim(
    "Section 5, Fig 4, without ends",
    "Many pendula oscillate with amplitudes comparable to the central one's.",
    unbounded("fig4_small"),
    (
        Control("large data at Omega = 8, alone in the centre", {MAIN: "unbounded/fig2_large"}),
        Control(
            "the largest data at Omega = -4, which stay in the centre",
            {MAIN: ("unbounded/amplitudes", largest_ones)},
        ),
        Control(
            "small data at Omega = -4, which disperse: no bulk is left to compare",
            {MAIN: "unbounded/fig3_small"},
            undecided=True,
        ),
    ),
)
def unbounded_many(run) -> Finding:
    times_of(run)
    one = run.isel(variant=0)
    fronts = one["front"].isel(piece_tau=-1).sel(front_power=FRONT).values
    powers = (one["state"].transpose("member", "row", "site").values ** 2).sum(axis=1)
    if fronts.min() <= 0:
        raise UndecidableError("nothing of the power of a front moves any more")
    bulks = [p[CENTRE : int(front)] for p, front in zip(powers, fronts, strict=True)]
    centres = powers[:, :CENTRE].mean(axis=1)
    pairs = list(zip(bulks, centres, strict=True))
    ratio = mean_limits([np.sqrt(bulk.mean() / centre) for bulk, centre in pairs], SURE.value)
    share = mean_limits(
        [(bulk > centre / FACTOR.value**2).mean() for bulk, centre in pairs], SURE.value
    )
    measured = {
        "over_centre": ratio.value,
        "over_centre_at_least": ratio.low,
        "over_centre_at_most": ratio.high,
        "share_at_least": share.low,
        "sites": 2.0 * np.floor(fronts.min()) + 1.0,
    }
    names = ("over_centre_at_least", "over_centre_at_most")
    alike = WithinFactor(FACTOR, *names, says="limits of the amplitude over that about the centre")
    many = Above(HALF_OF_THEM, "share_at_least", says="lower limit of the share of such sites")
    return judge(measured, AllOf(alike, many))


def large_ones(_, amplitudes):
    """Return of the runs over amplitudes those with the large central one of the paper."""
    sizes = amplitudes["central_modulus"].values
    return amplitudes.isel(variant=[int(np.abs(sizes - 5.0).argmin())])


@claim(
    "Introduction, without ends",
    "In the stability region the chain oscillates as its initial deviations determine.",
    unbounded("fig3_small", "fig2_large"),
    (
        Control(
            "large data at Omega = -4",
            {"unbounded/fig3_small": ("unbounded/amplitudes", large_ones)},
        ),
        Control("the unstable chain", {"unbounded/fig2_large": "unbounded/fig4_small"}),
    ),
)
def unbounded_determined(small, large) -> Finding:
    """Follow two members whose data differ by far less than can be seen: chaos would show it."""
    measured = {}
    for name, run in (("small", small), ("large", large)):
        if run.sizes["member"] < 2:
            raise UndecidableError("one run shows nothing of its neighbours")
        times_of(run)
        l2 = curves_of(run, "l2")
        measured[f"{name}_apart"] = np.abs(l2[1] - l2[0]).max() / l2[0].max()
        measured[f"{name}_apart_at_first"] = np.abs(l2[1, 0] - l2[0, 0]) / l2[0].max()
    says = "largest difference of l2 of two runs over its full scale"
    return judge(measured, Below(SEEN, "small_apart", "large_apart", says=says))
