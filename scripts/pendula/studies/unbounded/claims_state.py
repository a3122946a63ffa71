"""Claims on the fronts of infinite chains and on the states behind them.

Only the errors of measured numbers are considered: Student's t limits of means over members.
"""

import numpy as np
import xarray as xr
from latticode.measures.confidence import ConfidenceInterval, mean_limits
from replication.ledger.changes import roll, scale, take
from replication.ledger.claim import ClaimControl, Origin, claim
from replication.ledger.criterion import (
    AllOf,
    AtMost,
    Below,
    Finding,
    Near,
    UndecidableError,
    judge,
)
from replication.ledger.cutoff import Cutoff

from pendula.claims import CHANGE, CONSTANT, unbounded

from .bulk import BEHIND, BETWEEN, KINDS
from .claims import sure, times_of
from .measured import mean_powers, resolution, second_speeds, slope_ratios, speeds, thermal_powers

SECTION = 5

RESOLVED = Cutoff(1.0, "the place of a front is known to half a site, over the time of the fit")
FEW = 3
"""A claim is undecided if it is tested at fewer values of Omega than this."""

OMEGAS = "unbounded/omegas"


def a_stop(run: xr.Dataset) -> xr.Dataset:
    """Return, as a control, the run with fronts that stop at half of the time."""
    tau = run["piece_tau"]
    middle = run["front"].sel(piece_tau=0.5 * float(tau[-1]), method="nearest")
    return run.assign(front=run["front"].where(tau < 0.5 * tau[-1], middle))


@claim(
    "Introduction",
    "The central pendulum excites its neighbours, and this process continues.",
    unbounded("omegas"),
    (
        ClaimControl("the speed at another Omega", roll("predicted_speed", {"variant": 1})),
        ClaimControl("fronts that stop", a_stop),
    ),
)
def unbounded_front(run: xr.Dataset) -> Finding:
    times_of(run)
    off = np.abs(speeds(run)[0] - run["predicted_speed"].values).max()
    known = resolution(run["piece_tau"].values)
    measured = {"furthest": off, "furthest_over_resolution": off / known}
    label = (
        "largest difference between the speed, corrected for the delay of a pulled front, and that "
        "of linear spreading, over the resolution"
    )
    fails = "not every front moves at the speed of linear spreading"
    return judge(measured, AtMost(RESOLVED, "furthest_over_resolution", label=label), fails=fails)


def both_between(run: xr.Dataset) -> xr.Dataset:
    """Return, as a control, the run with equal powers of S and D between the fronts."""
    means = run["region_mean"]
    half = 0.5 * means.sel(kind=KINDS[0], drop=True)
    chosen = (means["region"] == BETWEEN) & (means["kind"] == KINDS[1])
    return run.assign(region_mean=means.where(~chosen, half).transpose(*means.dims))


@claim(
    "Beyond the paper",
    "Without noise A = -B behind the first front, and both fields are excited only behind a second "
    "front, which is slower wherever a region between the fronts forms.",
    unbounded("omegas"),
    (
        ClaimControl("second fronts as fast as the first", take(second_front="front")),
        ClaimControl("both fields excited between the fronts", both_between),
    ),
    origin=Origin.OWN,
)
def second_front(run: xr.Dataset) -> Finding:
    times_of(run)
    speed, error = second_speeds(run)
    between, omegas = mean_powers(run, BETWEEN).mean(axis=1), run["omega"].values
    is_comparable = np.isfinite(between) & np.isfinite(speed)
    if is_comparable.sum() < FEW:
        raise UndecidableError("fewer than three second fronts have a region ahead of them")
    measured = {
        "fastest": ((speed + error) / run["predicted_speed"].values)[is_comparable].max(),
        "share_between": np.nanmax(mean_powers(run, BETWEEN, KINDS[1]).mean(axis=1) / between),
    }
    slower = "largest upper limit of the speed of a second front over that of the first"
    filled = "largest share of |A + B|^2 / 2 in P between the fronts"
    criterion = AllOf(
        Below(1.0, "fastest", label=slower), Below(CONSTANT, "share_between", label=filled)
    )
    absent = ", ".join(f"{omega:g}" for omega in omegas[~np.isfinite(speed)])
    caveat = f"no second front has formed at Omega = {absent}" if absent else ""
    return judge(measured, criterion, caveat)


def ratios_of(powers: np.ndarray, expected: np.ndarray, tries: int) -> list[ConfidenceInterval]:
    """Return the ratios of P (variant, member) to thermal P, with limits, where both are known."""
    ratios = [
        ConfidenceInterval(*(bound / state for bound in mean_limits(power, sure(tries))))
        for power, state in zip(powers, expected, strict=True)
        if np.isfinite([*power, state]).all()
    ]
    if len(ratios) < FEW:
        raise UndecidableError("fewer than three regions have formed")
    return ratios


def next_states(thermal: xr.Dataset) -> xr.Dataset:
    """Return, as a control, the thermal states with the powers of the next Omega."""
    return roll(("power", "antisymmetric_power"), {"omega": 1})(thermal)


@claim(
    "Beyond the paper",
    "Behind the second front the infinite chain is in thermal equilibrium, where each pendulum "
    "oscillates at a finite amplitude.",
    unbounded("omegas", "thermal"),
    (ClaimControl("the thermal states of the next Omega", {"thermal": next_states}),),
    origin=Origin.OWN,
)
def unbounded_equilibrium(run: xr.Dataset, thermal: xr.Dataset) -> Finding:
    """Require that P behind the second front is near that of the thermal state.

    Between the fronts P relaxes over hundreds of sites. This region is shorter in short runs, so
    they do not test P there.
    """
    times_of(run)
    omegas, tries = run["omega"].values, run.sizes["variant"]
    formed = np.isfinite(second_speeds(run)[0])
    both = np.where(formed[:, None], mean_powers(run, BEHIND), np.nan)
    expected = thermal_powers(thermal, run)
    ratios = ratios_of(both, expected, tries)
    measured = {
        "at_least": min(ratio.low for ratio in ratios),
        "at_most": max(ratio.high for ratio in ratios),
    }
    label = "confidence interval of P behind the second front over thermal P"
    difference = np.nanmax(
        np.abs(thermal_powers(thermal, run, "antisymmetric_power") / expected - 1.0)
    )
    caveat = (
        "P alone hardly distinguishes this state from the one with A = -B, with a P that differs by"
        f" at most {difference:.0%}"
    )
    if absent := ", ".join(f"{omega:g}" for omega in omegas[~formed]):
        caveat += f"; no second front has formed at Omega = {absent}"
    return judge(measured, Near(1.0, CHANGE, "at_least", "at_most", label=label), caveat)


def largest_change(run: xr.Dataset, thermal: xr.Dataset) -> float:
    """Return the largest relative change of the law's slope with one state behind both fronts."""
    both, alone = (thermal_powers(thermal, run, f"{of}power") for of in ("", "antisymmetric_"))
    first, second = run["predicted_speed"].values, np.nan_to_num(second_speeds(run)[0])
    law = second * both + (first - second) * alone
    return np.nanmax(np.abs(first * np.array([both, alone]) / law - 1.0))


@claim(
    "Beyond the paper",
    "l2^2 grows as 2 (v_2 p + (v_1 - v_2) p') tau, with the thermal powers per pair p of both "
    "fields and p' of A = -B, the predicted speed v_1 of the first front and v_2 of the second.",
    unbounded("omegas", "thermal"),
    (
        ClaimControl("the thermal states of the next Omega", {"thermal": next_states}),
        ClaimControl(
            "a first front that is 1.5 times as fast", {OMEGAS: scale("predicted_speed", 1.5)}
        ),
    ),
    origin=Origin.OWN,
)
def unbounded_slope(run: xr.Dataset, thermal: xr.Dataset) -> Finding:
    times_of(run)
    omegas = run["omega"].values
    ratios = slope_ratios(run, thermal, sure(len(omegas)))
    known = [ratio.value for ratio in ratios if np.isfinite(ratio.value)]
    if len(known) < FEW:
        raise UndecidableError("the law is known at fewer than three values of Omega")
    measured = {"least": min(known), "largest": max(known)}
    deviating = [
        f"{omega:g} ({100.0 * (ratio.value - 1.0):+.1f} %)"
        for omega, ratio in zip(omegas, ratios, strict=True)
        if ratio.low > 1.0 or ratio.high < 1.0
    ]
    caveat = (
        "these runs test the slope, but hardly that there are two states: with p or p' behind both"
        f" fronts the slope would change by at most {largest_change(run, thermal):.0%}"
    )
    if deviating:
        caveat += f"; the slope differs significantly at Omega = {', '.join(deviating)}"
    label = "slope of l2^2 divided by the slope of its law"
    return judge(measured, Near(1.0, CHANGE, "least", "largest", label=label), caveat)
