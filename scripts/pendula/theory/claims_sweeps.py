"""Deciding functions for Figs 5 and 6: maxima and means over windows against the half-width M.

On a fixed window no norm can diverge with M: by (19) the norm on the infinite chain is finite,
and once the front does not reach the ends, a longer chain changes nothing.
"""

import numpy as np

from .bounds import proven_region, theorem_1_bound, theorem_2_constants, widened_bound
from .readings import (
    CHANGE,
    CONSTANT,
    FACTOR,
    constants,
    levelling,
    powers,
    rising_share,
    spread,
    swept,
)
from .verdicts import Finding, judge, undecided

# ASSUME: "nearly monotonic" means three of four steps; "whatever M" leaves out M < 10,
# where the ends are everywhere.
NEARLY_ALL, SHORTEST = 0.75, 10
# ASSUME: a maximum that falls to 90 % of the peak has fallen back.
FALLEN = 0.9
FIG_5, FIG_6, FIG_6_CAPTION = "[10, 50]", "[10, 70]", "[10, 40]"


def l2_grows_with_m(sweep) -> Finding:
    """Fig 5, right: nearly monotonic growth of the maximal l2 in M at Omega = 0."""
    m, l2 = swept(sweep, "l2", "max", FIG_5)
    level = levelling(m, l2)
    rising = l2[: np.searchsorted(m, level) + 1] if np.isfinite(level) else l2
    measured = {"growth": l2[-1] / l2[0], "rising": rising_share(rising), "level_from": level}
    holds = measured["growth"] > FACTOR and measured["rising"] > NEARLY_ALL
    caveat = f"up to M = {level:.0f}, where it levels off" if np.isfinite(level) else ""
    return judge(measured, "growth > 2, 3 of 4 steps up", holds, caveat)


def conjecture(sweep) -> Finding:
    """Fig 5, right: this confirms growth on the unbounded lattice as time goes to infinity."""
    m, l2 = swept(sweep, "l2", "max", FIG_5)
    level = levelling(m, l2)
    measured = {"growth": l2[-1] / l2[0], "level_from": level, "level": l2[-1]}
    if not measured["growth"] > 1.0:
        return judge(measured, "growth > 1", False)
    if np.isfinite(level):
        return undecided(
            measured,
            f"on a fixed window l2 levels off (from M = {level:.0f}); growth in time needs windows"
            " that grow with M",
        )
    return undecided(measured, "the chains are too short to see the level of a fixed window")


def maximum_independent_of_m(sweep) -> Finding:
    """Fig 5, right: l-infinity saturates to the same level whatever M."""
    m, linf = swept(sweep, "linf", "max", FIG_5)
    kept = linf[m >= SHORTEST] if np.any(m >= SHORTEST) else linf
    measured = {"spread": spread(kept), "mean": np.mean(kept)}
    return judge(measured, "spread for M >= 10 below 25 %", measured["spread"] < CHANGE)


def l2_decreases_with_m(sweep) -> Finding:
    """Fig 5, left: l2 decreases in M towards a level at Omega = -4, small data."""
    m, highest = swept(sweep, "l2", "max", FIG_5)
    _, average = swept(sweep, "l2", "mean", FIG_5)
    measured = {
        "fall_of_maximum": 1.0 - highest[-1] / highest[0],
        "fall_of_mean": 1.0 - average[-1] / average[0],
        "level_from": levelling(m, highest),
    }
    holds = measured["fall_of_maximum"] > CONSTANT and np.isfinite(measured["level_from"])
    caveat = ""
    if measured["fall_of_mean"] <= CONSTANT:
        caveat = "for the maximum that the text names, not for the average of the caption"
    return judge(measured, "the maximum falls by > 2 % to a level", holds, caveat)


def caption_of_fig_5(sweep) -> Finding:
    """Fig 5, caption: the norms are averaged over [10, 50]; then the text must hold for them."""
    _, average = swept(sweep, "l2", "mean", FIG_5)
    fall = 1.0 - average[-1] / average[0]
    fails = "the average does not decrease in M as the text says of this figure"
    return judge({"fall_of_mean": fall}, "the mean falls by > 2 %", fall > CONSTANT, fails=fails)


def agrees_with_theorem_2(case, sweep) -> Finding:
    """Fig 5, left: no growth, in agreement with Theorem 2."""
    start, energy = float(powers(case)[0]), float(case["energy"][0])
    parameters, boundary = constants(case), str(case.attrs["boundary"])
    region = proven_region(energy, start, parameters, boundary)
    observed = max(float(sweep["l2"].sel(quantity="pair").max()) ** 2, powers(case).max())
    delta_0, c_0 = theorem_2_constants(parameters)
    widened = widened_bound(energy, start, parameters)
    measured = {
        "delta": start,
        "delta_0": delta_0,
        "P_over_C0_delta": observed / (c_0 * start),
        "P_over_widened_bound": observed / widened,
    }
    caveat = ""
    if region == "theorem 2 widened":
        caveat = "outside delta_0 of the theorem as proved; inside once the bonds are kept"
    elif region == "none":
        caveat = "the data lie outside every proven region"
    return judge(measured, "P <= C_0 delta", observed <= c_0 * start, caveat)


def independent_of_m(sweep) -> Finding:
    """Fig 6, left: the maximal l2 does not change with N at Omega = 8, large data."""
    _, l2 = swept(sweep, "l2", "max", FIG_6)
    return judge({"spread": spread(l2)}, "spread < 2 %", spread(l2) < CONSTANT)


def bounded_by_theorem_1(case, sweep) -> Finding:
    """Fig 6, left: in agreement with Theorem 1."""
    bound = float(theorem_1_bound(float(case["energy"][0]), constants(case)))
    ratio = float(sweep["l2"].sel(quantity="pair").max()) ** 2 / bound
    return judge({"ratio": ratio}, "largest P over C <= 1", ratio <= 1.0)


def large_data_grow_with_m(sweep) -> Finding:
    """Fig 6, right: the maximal l2 grows with M at Omega = -4, large data."""
    m, l2 = swept(sweep, "l2", "max", FIG_6)
    peak = int(np.argmax(l2))
    measured = {"peak_over_first": l2[peak] / l2[0], "peak_at": m[peak], "last": l2[-1] / l2[peak]}
    caveat = ""
    if measured["last"] < FALLEN:
        caveat = f"up to M = {m[peak]}; beyond it falls back to {measured['last']:.2f} of the peak"
    return judge(measured, "peak over first > 2", measured["peak_over_first"] > FACTOR, caveat)


def large_data_diverge(sweep) -> Finding:
    """Fig 6, right: it apparently diverges as N goes to infinity."""
    m, l2 = swept(sweep, "l2", "max", FIG_6)
    level = levelling(m, l2)
    measured = {"level_from": level, "last": l2[-1], "largest": l2.max()}
    fails = f"it is level from M = {level:.0f} on, as it must be on a fixed window"
    return judge(measured, "no level", not np.isfinite(level), fails=fails)


def caption_of_fig_6(left, right) -> Finding:
    """Fig 6, caption: averages over [10, 40] rather than maxima over [10, 70]."""
    readings = (("max", FIG_6), ("mean", FIG_6_CAPTION))
    flat = [spread(swept(left, "l2", *reading)[1]) < CONSTANT for reading in readings]
    grows = []
    for reading in readings:
        values = swept(right, "l2", *reading)[1]
        grows.append(values.max() / values[0] > FACTOR)
    measured = {"flat_by_text": flat[0], "flat_by_caption": flat[1]}
    measured |= {"grows_by_text": grows[0], "grows_by_caption": grows[1]}
    if flat[0] == flat[1] and grows[0] == grows[1]:
        return undecided(measured, "both readings fit what the text says of the figure")
    return judge(measured, "the text holds for the caption's reading", flat[1] and grows[1])


def not_technical(case, sweep) -> Finding:
    """Fig 6, right: large data leave the bound of Theorem 2, so that its limitation is real."""
    m, l2 = swept(sweep, "l2", "max", FIG_6)
    c_0 = theorem_2_constants(constants(case))[1]
    start = float(powers(case)[0])
    measured = {"P_over_delta": l2[-1] ** 2 / start, "C_0": c_0, "longest_chain": m[-1]}
    caveat = "growth without bound in time is not decided by a fixed window"
    return judge(measured, "P over delta > C_0", measured["P_over_delta"] > c_0, caveat)


def unbounded_in_time(*sweeps) -> Finding:
    """Introduction: l2 diverges on the unbounded chain as time goes to infinity."""
    measured = {}
    for name, sweep in zip(("fig5_right", "fig6_right"), sweeps, strict=True):
        short = swept(sweep, "l2", "max", FIG_6_CAPTION)[1][-1]
        measured[name] = swept(sweep, "l2", "max", FIG_6)[1][-1] / short
    return undecided(measured, "the ratio of the maxima to tau = 70 and 40 is no limit in time")


def not_shown(check) -> Finding:
    """Fig 5: a similar dependence, not shown, for Omega = 8."""
    l2 = check["l2"].values
    level = levelling(check["half_width"].values, l2, CONSTANT)
    measured = {"fall": 1.0 - l2[-1] / l2[0], "level_from": level}
    return judge(measured, "l2 does not grow and levels off", l2[-1] <= l2[0] and level < np.inf)
