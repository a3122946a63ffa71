"""Deciding functions for Figs 2 to 4: what the text reads from norms against time."""

import numpy as np

from .bounds import theorem_1_bound, theorem_3_bound
from .readings import CHANGE, FACTOR, LARGE, constants, halves, largest, late, mean, powers
from .verdicts import Finding, UndecidableError, judge

# ASSUME: what else the words mean. "Decreases": to less than half; "oscillates between": squares
# of norms correlated below -0.8; "effectively separated": three quarters of A are kept; "is
# unstable": grows by e within 3; "many": a quarter; a pendulum is "excited" at a fifth of the
# largest amplitude; curves are apart at 30 % of scale; a rise of 10 % is worth a caveat.
HALF, ANTICORRELATED, KEPT, MANY, EXCITED, APART, RISE = 0.5, -0.8, 0.75, 0.25, 0.2, 0.3, 0.1


def bounded_by_theorem_1(small, large) -> Finding:
    """Fig 2: Theorem 1 bounds l2 at Omega = 8."""
    ratios = [
        powers(ds).max() / theorem_1_bound(float(ds["energy"][0]), constants(ds))
        for ds in (small, large)
    ]
    measured = dict(zip(("small", "large"), ratios, strict=True))
    return judge(measured, "largest P over C <= 1", max(ratios) <= 1.0)


def centre_decreases(small) -> Finding:
    """Fig 2, upper: the amplitude of the central pendulum decreases."""
    a = late(small)["linf"].sel(component="A").max() / small["linf"].sel(component="A")[0]
    return judge({"largest_late_amplitude": a}, "late over initial < 0.5", a < HALF)


def modes_exchange(small) -> Finding:
    """Fig 2, upper: l2 oscillates between A and B."""
    a, b = late(small)["l2"].values ** 2
    with np.errstate(invalid="ignore"):  # constant norms have no correlation
        correlation, swing = np.corrcoef(a, b)[0, 1], float(np.ptp(a) / np.mean(a))
    measured = {"correlation": correlation, "swing_of_A": swing}
    holds = correlation < ANTICORRELATED and swing > CHANGE
    return judge(measured, "correlation of |A|^2, |B|^2 < -0.8, swing > 25 %", holds)


def maxima_comparable(small) -> Finding:
    """Fig 2, upper: l-infinity of A and B are comparable and change little after a while."""
    first, second = halves(small)
    ratio = mean(late(small), "linf", "A") / mean(late(small), "linf", "B")
    change = max(abs(mean(second, "linf", k) / mean(first, "linf", k) - 1.0) for k in "AB")
    measured = {"ratio": ratio, "change": change}
    holds = 1 / FACTOR < ratio < FACTOR and change < CHANGE
    return judge(measured, "ratio within 2, change between halves < 25 %", holds)


def modes_separate(large) -> Finding:
    """Fig 2, lower: A moves apart from B."""
    settled = late(large)
    share = settled["linf"].sel(component="A") / large["linf"].sel(component="A")[0]
    ratio = settled["l2"].sel(component="B").max() / settled["l2"].sel(component="A").min()
    measured = {"smallest_A_kept": share.min(), "B_over_A": ratio}
    holds = measured["smallest_A_kept"] > KEPT and ratio < 1.0 / LARGE
    return judge(measured, "A keeps 75 % of its maximum, l2 of B below a third of A", holds)


def centre_alone(large) -> Finding:
    """Fig 2, lower: the central pendulum does not excite large oscillations of others."""
    start = float(large["linf"].sel(component="A")[0])
    a = large.sel(component="A")
    others = np.sqrt(np.maximum(0.0, a["l2"] ** 2 - a["linf"] ** 2)).max() / start
    partner = large["linf"].sel(component="B").max() / start
    measured = {"all_other_A": others, "largest_B": partner}
    return judge(measured, "each below a third of A_0", max(others, partner) < 1.0 / LARGE)


def like_omega_8(eight, four) -> Finding:
    """Fig 3, upper: no drastic difference to Omega = 8."""
    l2 = np.sqrt(powers(late(four)).mean() / powers(late(eight)).mean())
    linf = largest(late(four)).mean() / largest(late(eight)).mean()
    measured = {"l2_ratio": l2, "linf_ratio": linf}
    return judge(measured, "ratios within 2", all(1 / FACTOR < x < FACTOR for x in (l2, linf)))


def modes_mix(large) -> Finding:
    """Fig 3, lower: A and B mix up."""
    _, second = halves(large)
    ratio = mean(second, "l2", "A") / mean(second, "l2", "B")
    initial = float(large["l2"].sel(component="A")[0] / large["l2"].sel(component="B")[0])
    measured = {"l2_ratio": ratio, "initial_ratio": initial}
    return judge(measured, "late ratio of l2 within 2", 1 / FACTOR < ratio < FACTOR)


def others_excited(large) -> Finding:
    """Fig 3, lower: l2 grows, since the central pendulum excites large oscillations of others."""
    _, second = halves(large)
    growth = np.sqrt(powers(second).mean() / powers(large)[0])
    sites = powers(second).mean() / np.mean(largest(second) ** 2)
    measured = {"l2_growth": growth, "pendula_in_motion": sites}
    return judge(measured, "l2 grows by 2, sites in motion > 3", growth > FACTOR and sites > LARGE)


def maximum_stays(large) -> Finding:
    """Fig 3, lower: l-infinity stays at the level of the initial data."""
    ratio = largest(late(large)) / largest(large)[0]
    measured = {"mean": ratio.mean(), "largest": ratio.max()}
    grown = measured["mean"] > 1.0 + RISE
    caveat = f"it rises by {100 * (measured['mean'] - 1):.0f} % on average" if grown else ""
    return judge(measured, "within a factor of 2", ratio.max() < FACTOR, caveat)


def unstable_at_zero(small, large) -> Finding:
    """Fig 4: the zero equilibrium is unstable at Omega = 0."""
    rates = [
        0.5 * np.log(powers(ds.sel(tau=slice(0, 3))).max() / powers(ds)[0]) / 3.0
        for ds in (small, large)
    ]
    measured = {"mean_rate_small": rates[0], "mean_rate_large": rates[1]}
    return judge(measured, "the small data grow by e within 3", rates[0] * 3.0 > 1.0)


def maximum_settles(small, large) -> Finding:
    """Fig 4: growth stops at a certain l-infinity norm."""
    changes = []
    for ds in (small, large):
        first, second = halves(ds)
        changes.append(abs(largest(second).mean() / largest(first).mean() - 1.0))
    measured = {"change_small": changes[0], "change_large": changes[1]}
    return judge(measured, "change between halves < 25 %", max(changes) < CHANGE)


def sum_exceeds_maximum(small, large) -> Finding:
    """Fig 4: l2 is significantly larger than l-infinity."""
    ratios = [np.mean(np.sqrt(powers(late(ds))) / largest(late(ds))) for ds in (small, large)]
    measured = {"small": ratios[0], "large": ratios[1]}
    return judge(measured, "l2 over l-infinity > 3", min(ratios) > LARGE)


def many_in_motion(small, large) -> Finding:
    """Fig 4: many pendula oscillate with amplitudes comparable to the central one's."""
    shares = []
    for ds in (small, large):
        settled = late(ds)
        pendula = 2.0 * (2 * int(ds.attrs["half_width"]) + 1)
        shares.append(np.mean(powers(settled) / largest(settled) ** 2) / pendula)
    measured = {"share_small": shares[0], "share_large": shares[1]}
    return judge(measured, "P over l-infinity^2 and 2N > 1/4", min(shares) > MANY)


def panels_alike(small, large) -> Finding:
    """Fig 4: no visible differences between upper and lower panels."""
    a, b = late(small), late(large)
    l2 = np.sqrt(powers(b).mean() / powers(a).mean()) - 1.0
    linf = largest(b).mean() / largest(a).mean() - 1.0
    early = np.abs(np.sqrt(powers(large)) - np.sqrt(powers(small)))
    scale = np.sqrt(powers(a).mean())
    apart = small["tau"].values[early > APART * scale]
    until = apart[-1] if len(apart) else 0.0
    measured = {"l2": l2, "linf": linf, "curves_apart_until": until, "initially": early[0]}
    caveat = ""
    if early[0] > RISE * largest(a).mean():
        caveat = "in the mean after tau = 10; before, and in detail, the curves differ"
    return judge(measured, "late means within 25 %", max(abs(l2), abs(linf)) < CHANGE, caveat)


def finite_bound(*trajectories) -> Finding:
    """Theorem 3 along the paper's own runs."""
    ratios = []
    for ds in trajectories:
        sites = 2 * int(ds.attrs["half_width"]) + 1
        bound = theorem_3_bound(float(ds["energy"][0]), sites, constants(ds))
        ratios.append(powers(ds).max() / bound)
    return judge({"largest": max(ratios)}, "largest P over C_N <= 1", max(ratios) <= 1.0)


def equilibrium(small) -> Finding:
    """Abstract: excitation spreads until all pendula oscillate at finite amplitude."""
    if "modulus" not in small:
        raise UndecidableError("the trajectory holds no amplitudes of single pendula")
    modulus = small["modulus"].max("component").values
    level = EXCITED * modulus.max()
    reached = [modulus[edge].max() > level for edge in (0, -1)]
    arrival = np.flatnonzero(np.maximum(modulus[0], modulus[-1]) > level)
    when = float(small["snapshot_tau"][arrival[0]]) if len(arrival) else np.inf
    first, second = halves(small)
    change = abs(powers(second).mean() / powers(first).mean() - 1.0)
    measured = {"arrival_at_the_ends": when, "change_of_P": change}
    caveat = f"the spreading stops at tau = {when:.0f} since the chain ends there"
    holds = all(reached) and change < CHANGE
    return judge(measured, "ends reached, then P changes by < 25 %", holds, caveat)
