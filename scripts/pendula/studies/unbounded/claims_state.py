"""What moves on infinite chains: the fronts, the states behind them, and their largest amplitude.

Energy is the only integral, and a front that is pulled leaves none behind. So the equilibrium is
the thermal state of no energy, which `thermal` solves to many digits, of both fields or of A = -B.
Only the errors of what is measured count: limits of means over members, by Student's t.
"""

import numpy as np
from latticode.measures.confidence import Limits, mean_limits

from pendula.ledger.changes import repeat, roll, scale, take
from pendula.ledger.claim import CHANGE, CONSTANT, Control, claim, unbounded
from pendula.ledger.criterion import (
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff

from .bulk import (
    BEHIND,
    BETWEEN,
    KINDS,
    LATE,
    late_means,
    law_of,
    mean_powers,
    powers_of,
    slope_ratios,
    thermal_powers,
)
from .claims import DIFFUSING, curves_of, sure, times_of
from .extremes import mean_maximum
from .measured import resolution, second_speeds, speeds

SECTION = 5

RESOLVED = Cutoff(1.0, "the place of a front is known to half a site, over the time of the fit")
FAR_AHEAD = 1e6
"""The tau at which the law of the largest amplitude is quoted."""

OMEGAS, MAIN = "unbounded/omegas", "unbounded/fig4_small"


def a_stop(run, name: str = "front"):
    """Return the run with fronts that stop at half the time."""
    tau = run["piece_tau"]
    middle = run[name].sel(piece_tau=0.5 * float(tau[-1]), method="nearest")
    return run.assign({name: run[name].where(tau < 0.5 * tau[-1], middle)})


def at_the_first_front(transverse):
    """Return the speeds of second fronts as if all were as fast as the fastest one."""
    speeds = transverse["second_speed"]
    return transverse.assign(second_speed=0.0 * speeds + float(speeds.max()))


def both_between(run):
    """Return the run with both fields alike between the fronts."""
    means = run["region_mean"]
    half = 0.5 * means.sel(kind=KINDS[0], drop=True)
    chosen = (means["region"] == BETWEEN) & (means["kind"] == KINDS[1])
    return run.assign(region_mean=means.where(~chosen, half).transpose(*means.dims))


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
    says = (
        "largest difference of the speed, with the known delay of a pulled front added back, from "
        "that of linear spreading, over the resolution"
    )
    fails = "not every front moves at the speed of linear spreading"
    return judge(measured, AtMost(RESOLVED, "furthest_over_resolution", says=says), fails=fails)


def of_other_omega(data):
    """Return a change: the speeds of second fronts at another Omega."""
    return roll("second_speed", {"omega": 2})(data)


NEARER = Cutoff(0.5, "nearer to its predicted speed than to that of the first front")
FEW = 3
"""Second fronts that are compared: fewer show no dependence on Omega."""


@claim(
    "Beyond the paper",
    "Behind the front A = -B, until both fields are excited behind a second front, which moves at"
    " the speed at which a small A + B spreads on the chaotic chain with A = -B.",
    unbounded("omegas", "transverse"),
    (
        Control("the speed at another Omega", {"transverse": of_other_omega}),
        Control("the speed of the first front", {"transverse": at_the_first_front}),
        Control("second fronts that stop", {OMEGAS: lambda run: a_stop(run, "second_front")}),
        Control("both fields excited between the fronts", {OMEGAS: both_between}),
    ),
)
def second_front(run, transverse) -> Finding:
    times_of(run)
    (found, error), omegas = second_speeds(run), run["omega"].values
    known = transverse.reindex(omega=omegas, method="nearest", tolerance=1e-9)
    expected, alone = known["second_speed"].values, mean_powers(run, BETWEEN, KINDS[1])
    seen = np.isfinite(found) & (expected > 0.0)
    if seen.sum() < FEW:
        raise UndecidableError("fewer than three second fronts have formed")
    slower = seen & (expected < run["predicted_speed"].values)  # elsewhere both fronts are as fast
    if slower.sum() < FEW:
        raise UndecidableError("fewer than three second fronts are predicted to be slower")
    apart = (run["predicted_speed"].values - expected)[slower]
    off = np.abs(found - expected)[slower]
    half = np.sqrt(error**2 + known["second_speed_error"].values ** 2)[slower]
    between = np.nanmax((alone / mean_powers(run, BETWEEN)).mean(axis=1))
    measured = {
        "second_furthest_at_least": np.sort((off - half) / apart)[-2],  # chance spoils one of five
        "third_at_most": np.sort((off + half) / apart)[FEW - 1],
        "share_between": between,
        "fronts": seen.sum(),
        "values": omegas.size,
    }
    far = Below(
        NEARER,
        "second_furthest_at_least",
        "third_at_most",
        says="distance from the predicted speed over that of the first front's, by its limits: the "
        f"lower one of all fronts but one, and the upper one of {FEW} of them",
    )
    if far.failing(measured) == ["third_at_most"]:
        return undecided(measured, "the limits of the speeds are too wide")
    filled = Below(CONSTANT, "share_between", says="largest share of |A + B|^2 / 2 in P between")
    return judge(measured, AllOf(far, filled), _not_formed(omegas, found, expected))


def _not_formed(omegas: np.ndarray, found: np.ndarray, expected: np.ndarray) -> str:
    """Return a caveat on the Omega where no second front has formed, predicted or not."""
    absent = ~np.isfinite(found)
    if not absent.any():
        return ""
    listed = [", ".join(f"{omega:g}" for omega in omegas[one]) for one in
              (absent, absent & (expected > 0.0))]  # fmt: skip
    but = f", though one is predicted at {listed[1]}" if listed[1] else ""
    return f"no second front has formed at Omega = {listed[0]}{but}"


def ratios_of(powers: np.ndarray, expected: np.ndarray, tries: int) -> list[Limits]:
    """Return limits of P (variant, member) over that of thermal states, where both are known."""
    pairs = zip(powers, expected, strict=True)
    return [
        Limits(*(bound / state for bound in mean_limits(one, sure(tries))))
        for one, state in pairs
        if np.isfinite([*one, state]).all()
    ]


def as_of_waves(run):
    """Return the run with powers that fall as 1 / tau."""
    return scale("region_mean", run["piece_tau"][-1] / run["piece_tau"])(run)


def noise_of_powers(run):
    """Return the run with noise for the powers of its regions, of the mean that they had."""
    powers = run["region_mean"]
    drawn = np.random.default_rng(2017).exponential(float(powers.mean()), powers.shape)
    return run.assign(region_mean=(powers.dims, np.where(np.isfinite(powers), drawn, np.nan)))


def next_states(thermal):
    """Return thermal states with the powers of the next Omega."""
    return roll("power", {"omega": 1})(roll("antisymmetric_power", {"omega": 1})(thermal))


@claim(
    "Beyond the paper",
    "Behind each front the infinite chain is in thermal equilibrium, where each pendulum oscillates"
    " at a finite amplitude.",
    unbounded("omegas", "thermal"),
    (
        Control("the thermal states of the next Omega", {"thermal": next_states}),
        Control("powers that fall as 1 / tau, as for dispersing waves", {OMEGAS: as_of_waves}),
        Control("noise of the same mean in place of powers", {OMEGAS: noise_of_powers}),
    ),
)
def unbounded_equilibrium(run, thermal) -> Finding:
    times_of(run)
    omegas, tries = run["omega"].values, 2 * run.sizes["variant"]
    formed = np.isfinite(second_speeds(run)[0])
    both = np.where(formed[:, None], mean_powers(run, BEHIND), np.nan)
    ratios = ratios_of(both, thermal_powers(thermal, omegas), tries)
    alone = thermal_powers(thermal, omegas, "antisymmetric_power")
    between = ratios_of(mean_powers(run, BETWEEN), alone, tries)
    if len(ratios) < FEW or len(between) < FEW:
        raise UndecidableError("fewer than three regions have formed")
    spans = late_means(powers_of(run, BEHIND)[formed], run, 2).mean(axis=2)
    change = spans[1] / spans[0]
    measured = {
        "least": min(one.value for one in ratios),
        "largest": max(one.value for one in ratios),
        "at_least": min(one.low for one in ratios),
        "at_most": max(one.high for one in ratios),
        "between_at_most": min(one.high for one in between),
        "between_at_least": max(one.low for one in between),
        "least_change": change.min(),
        "largest_change": change.max(),
    }
    says = "confidence interval of P behind the second front over thermal P"
    alone_says = "P between the fronts over that of the thermal state with A = -B"
    criterion = AllOf(
        Near(1.0, CHANGE, "at_least", "at_most", says=says),
        AtLeast(1.0 - CHANGE.value, "between_at_most", says=f"upper limit of {alone_says}"),
        AtMost(1.0 + CHANGE.value, "between_at_least", says=f"lower limit of {alone_says}"),
        Near(1.0, CHANGE, "least_change", "largest_change",
             says="P in the last quarter of the run over the third"),
    )  # fmt: skip
    absent = ", ".join(f"{omega:g}" for omega in omegas[~formed])
    only = f"at Omega = {absent} only the equilibrium with A = -B is reached" if absent else ""
    return judge(measured, criterion, only)


def one_state(thermal):
    """Return thermal states with the power of both fields also where A = -B."""
    return thermal.assign(antisymmetric_power=thermal["power"])


@claim(
    "Beyond the paper",
    "l2^2 grows as 2 (v_2 p + (v_1 - v_2) p') tau, with the thermal powers per pair p of both "
    "fields and p' of A = -B, and the predicted speeds v_1 and v_2 of the fronts.",
    unbounded("omegas", "transverse", "thermal"),
    (
        Control("the thermal states of the next Omega", {"thermal": next_states}),
        Control(
            "a first front that is half as fast again", {OMEGAS: scale("predicted_speed", 1.5)}
        ),
        Control("l2 follows tau^(1/4)", {OMEGAS: next(iter(DIFFUSING.values()))}),
    ),
)
def unbounded_slope(run, transverse, thermal) -> Finding:
    times_of(run)
    omegas = run["omega"].values
    laws = law_of(run, thermal, transverse)
    known = [
        (omega, one)
        for omega, one in zip(omegas, slope_ratios(run, laws, sure(len(omegas))), strict=True)
        if np.isfinite(one.value)
    ]
    if len(known) < FEW:
        raise UndecidableError("the law is known at fewer than three values of Omega")
    measured = {f"at_omega_{omega:g}": one.value for omega, one in known} | {
        "least": min(one.value for _, one in known),
        "largest": max(one.value for _, one in known),
    }
    apart = [
        f"{omega:g} ({100.0 * (one.value - 1.0):+.1f} %)"
        for omega, one in known
        if not one.low < 1.0 < one.high
    ]
    caveats = [f"significantly off at Omega = {', '.join(apart)}"] if apart else []
    alike = [one.value for one in slope_ratios(run, law_of(run, one_state(thermal), transverse))]
    within = np.abs(np.array(alike) - 1.0) < CHANGE.value
    if within[np.isfinite(alike)].all():
        caveats += [
            "the criterion cannot tell this from the law of one front with P everywhere "
            f"({np.nanmin(alike):.3f} to {np.nanmax(alike):.3f})"
        ]
    says = "slope of l2^2 over that of its law"
    return judge(measured, Near(1.0, CHANGE, "least", "largest", says=says), "; ".join(caveats))


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
    fronts = late_means(one["front"].transpose("member", "piece_tau").values, run)[0]
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
    above = "upper confidence limit of the norm over that in equilibrium up to the front, minus 1"
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
