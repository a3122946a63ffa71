"""What moves on infinite chains: the front, the bulk behind it, and its largest amplitude."""

from collections.abc import Callable

import numpy as np

from pendula.ledger.changes import repeat, roll, scale, take
from pendula.ledger.chaos import FAR_AS_NEAR, SENSITIVITY, almost_equal
from pendula.ledger.claim import CONSTANT, FACTOR, SETTLED, Control, claim, unbounded
from pendula.ledger.criterion import (
    Above,
    AllOf,
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
from pendula.measures.confidence import mean_limits
from pendula.measures.difference import VISIBLE

from .bulk import LATE, late_means
from .claims import curves_of, sure, times_of
from .extremes import mean_maximum
from .measured import FRONT, resolution, speeds

SECTION = 5

RESOLVED = Cutoff(1.0, "the place of a front is known to half a site, over the time of the fit")
HALF_OF_THEM = Cutoff(0.5, '"many": more than half of the sites that the front has passed', 1.0)
SEEN = Cutoff(VISIBLE, "a reader sees a difference of 1 % of full scale, about the width of a line")
FAR_AHEAD = 1e6
"""The tau at which the law of the largest amplitude is quoted."""

OMEGAS, MAIN = "unbounded/omegas", "unbounded/fig4_small"


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
        Control(
            "the speed of linear spreading at another Omega",
            roll("predicted_speed", {"variant": 1}),
        ),
        Control("fronts that stop", a_stop),
        Control("the small case at Omega = -4", "fig3_small"),
        Control("the large case at Omega = 8", "fig2_large"),
    ),
)
def unbounded_front(run) -> Finding:
    times_of(run)
    off = np.abs(speeds(run, corrected=True)[0] - run["predicted_speed"].values)
    known = resolution(run["piece_tau"].values)
    measured = {
        "furthest": off.max(),
        "resolution": known,
        "furthest_over_resolution": off.max() / known,
        "values": len(off),
    }
    says = "largest error of the speed of linear spreading, over the resolution"
    fails = "not every front moves at the speed of linear spreading"
    return judge(measured, AtMost(RESOLVED, "furthest_over_resolution", says=says), fails=fails)


LARGEST = ("linf", "bulk_maximum")


def at_the_next_omega(right, omegas):
    """Return the run at the next Omega as one at that of the right one."""
    own = float(right["omega"][0])
    beyond = np.flatnonzero(omegas["omega"].values > own)[:1]
    return omegas.isel(variant=beyond).assign(omega=("variant", [own]))


@claim(
    "Introduction",
    "The l-infinity norm remains finite at the dynamical equilibrium.",
    unbounded("fig4_small", "thermal"),
    (
        Control("l2, which grows as the square root of tau, in its place", {MAIN: take(linf="l2")}),
        Control("largest amplitudes higher by 5 %", {MAIN: scale(LARGEST, 1.05)}),
        Control("largest amplitudes lower by 5 %", {MAIN: scale(LARGEST, 0.95)}, undecided=True),
        Control(
            "a maximum that stops growing with the number of sites",
            {MAIN: repeat("neighbours", 4, slice(4, None), "bulk_maximum")},
            undecided=True,
        ),
        Control(
            "eight times as many sites",
            {MAIN: lambda run: run.assign_coords(neighbours=8 * run["neighbours"])},
            undecided=True,
        ),
        Control("the bulk at another Omega", {MAIN: (OMEGAS, at_the_next_omega)}, undecided=True),
        Control("the small case at Omega = -4", {MAIN: "unbounded/fig3_small"}, undecided=True),
    ),
)
def unbounded_maximum(run, thermal) -> Finding:
    """Compare the largest amplitudes with those of the thermal state, in which nothing is fitted.

    "Remains finite" is read as: in equilibrium the norm has a known finite mean on any number of
    sites. The largest modulus on N neighbouring sites of the bulk has to be that of the thermal
    state for every N, and the norm of the whole chain not above that of a chain that is all in
    equilibrium: the sites that the front has just passed are not. Lower maxima decide nothing,
    because no theory predicts how these go on.
    """
    one, sizes = run.isel(variant=0), run["neighbours"].values
    late = times_of(run) > LATE * float(run["tau"][-1])
    if float(one["omega"]) != float(thermal["bound_omega"]):
        raise UndecidableError("the thermal state at this Omega was not computed")
    found = one["bulk_maximum"].transpose("neighbours", "member", "piece_tau").values
    found, expected = late_means(found, run)[0], mean_maximum(thermal, sizes)
    fronts = late_means(one["front"].sel(front_power=FRONT).values, run)[0]
    norms = curves_of(run, "linf")[:, late].mean(axis=1) / mean_maximum(thermal, fronts)
    if len(norms) < 2 or not np.isfinite([*found, norms]).all():
        raise UndecidableError("there are fewer than two complete runs, or the bulk is too short")
    blocks = mean_limits((found / expected[:, None]).T, sure(len(sizes)))
    norm, ahead = mean_limits(norms, sure()), float(one["predicted_speed"]) * FAR_AHEAD
    measured = {
        **{f"of_{n}_sites": mean for n, mean in zip(sizes, found.mean(axis=1), strict=True)},
        **{f"thermal_of_{n}_sites": mean for n, mean in zip(sizes, expected, strict=True)},
        "bulk_at_least": blocks.low.min(),
        "bulk_at_most": blocks.high.max(),
        "norm_over_thermal": norm.value,
        "norm_over_thermal_error": norm.half,
        "norm_above_thermal": norm.high - 1.0,
        "last": curves_of(run, "linf")[:, -1].mean(),
        "thermal_at_1e6": mean_maximum(thermal, ahead),
    }
    if measured["bulk_at_least"] < 1.0 - CONSTANT.value:
        return undecided(measured, "the largest amplitudes of the bulk are below thermal ones")
    says = f"confidence interval of the maximum on {sizes[0]} to {sizes[-1]} sites over thermal"
    above = "upper confidence limit of the norm over that in equilibrium up to the front, less 1"
    criterion = AllOf(
        Near(1.0, CONSTANT, "bulk_at_least", "bulk_at_most", says=says),
        AtMost(CONSTANT, "norm_above_thermal", says=above),
    )
    caveat = (
        "it is that of the thermal state on the N sites behind the front, which is finite but "
        "grows without bound, as (ln N)^(1/4); at tau = 1e6 it would be "
        f"{measured['thermal_at_1e6']:.2f}"
    )
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, Fig 3 lower",
    "The l-infinity norm stays at its initial level.",
    (*unbounded("fig3_large"), SENSITIVITY),
    (
        Control("the small case at Omega = 0, where it grows", {"fig3_large": "fig4_small"}),
        Control("the small case at Omega = -4, which disperses", {"fig3_large": "fig3_small"}),
        FAR_AS_NEAR,
    ),
    reading="infinite chain",
)
def unbounded_large_maximum(run, sensitivity) -> Finding:
    near = almost_equal(sensitivity, run.attrs["perturbation"])
    tau, linf = times_of(run), curves_of(run, "linf")
    late = linf[:, tau >= SETTLED]
    means = mean_limits(late.mean(axis=1) / linf[:, 0], sure())
    measured = {
        "mean_over_initial": means.value,
        "mean_over_initial_at_most": means.high,
        "mean_over_initial_at_least": means.low,
        "largest_over_initial": (late.max(axis=1) / linf[:, 0]).max(),
        "end": tau[-1],
    }
    names = ("mean_over_initial_at_most", "mean_over_initial_at_least")
    says = "confidence interval of the mean since tau = 10 over the initial value"
    criterion = AllOf(WithinFactor(FACTOR, *names, says=says), near.criterion)
    return judge(measured | near.measured, criterion, near.caveat)


def from_amplitude(size: float) -> Callable:
    """Return a change: of the runs over amplitudes, which are given second, those nearest to it."""

    def change(_, runs):
        nearest = int(np.abs(runs["central_modulus"].values - size).argmin())
        return runs.isel(variant=[nearest])

    return change


CENTRE = 8
"""Sites about the centre, on each side, whose mean is taken as the central amplitude."""


@claim(
    "Section 5, Fig 4",
    "Many pendula oscillate with large and comparable amplitudes with respect to the central one.",
    unbounded("fig4_small"),
    (
        Control("the large case at Omega = 8, which stays at the centre", "fig2_large"),
        Control(
            "the largest initial condition at Omega = -4, which stays at the centre",
            ("amplitudes", from_amplitude(8.0)),
        ),
        Control(
            "the small case at Omega = -4, which disperses and leaves no bulk to compare",
            "fig3_small",
            undecided=True,
        ),
    ),
    reading="infinite chain",
)
def unbounded_many(run) -> Finding:
    times_of(run)
    one = run.isel(variant=0)
    fronts = one["front"].isel(piece_tau=-1).sel(front_power=FRONT).values
    powers = (one["state"].transpose("member", "row", "site").values ** 2).sum(axis=1)
    if fronts.min() <= 0:
        raise UndecidableError("no front of this power is left")
    bulks = [p[CENTRE : int(front)] for p, front in zip(powers, fronts, strict=True)]
    centres = powers[:, :CENTRE].mean(axis=1)
    pairs = list(zip(bulks, centres, strict=True))
    ratios = [np.sqrt(bulk.mean() / centre) for bulk, centre in pairs]
    shares = [(bulk > centre / FACTOR.value**2).mean() for bulk, centre in pairs]
    ratio, share = mean_limits(ratios, sure()), mean_limits(shares, sure())
    measured = {
        "over_centre": ratio.value,
        "over_centre_at_least": ratio.low,
        "over_centre_at_most": ratio.high,
        "share_at_least": share.low,
        "sites": 2.0 * np.floor(fronts.min()) + 1.0,
    }
    names = ("over_centre_at_least", "over_centre_at_most")
    alike = WithinFactor(
        FACTOR, *names, says="confidence interval of the amplitude over the central one"
    )
    many = Above(
        HALF_OF_THEM,
        "share_at_least",
        says="lower confidence limit of the share of such sites",
    )
    return judge(measured, AllOf(alike, many))


@claim(
    "Introduction",
    "In the stability region the chain performs stable oscillations that the initial deviations"
    " determine.",
    unbounded("fig3_small", "fig2_large"),
    (
        Control(
            "the large case at Omega = -4", {"fig3_small": ("amplitudes", from_amplitude(5.0))}
        ),
        Control("the unstable case at Omega = 0", {"fig2_large": "fig4_small"}),
    ),
    reading="infinite chain",
)
def unbounded_determined(small, large) -> Finding:
    """Follow two members whose data differ by far less than can be seen: chaos would show it."""
    measured = {}
    for name, run in (("small", small), ("large", large)):
        if run.sizes["member"] < 2:
            raise UndecidableError("a single run cannot show how close runs part")
        times_of(run)
        l2 = curves_of(run, "l2")
        measured[f"{name}_apart"] = np.abs(l2[1] - l2[0]).max() / l2[0].max()
        measured[f"{name}_apart_at_first"] = np.abs(l2[1, 0] - l2[0, 0]) / l2[0].max()
    says = "largest difference of l2 of two slightly different runs, over full scale"
    return judge(measured, Below(SEEN, "small_apart", "large_apart", says=says))
