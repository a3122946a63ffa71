"""Fig 5: maxima and means over a window against the half-width M, small data.

On a fixed window no norm can diverge with M: by (19) the norm on the infinite chain is finite,
and once the front does not reach the ends, a longer chain changes nothing.
"""

import numpy as np

from pendula.ledger.readings import (
    CHANGE,
    CONSTANT,
    FACTOR,
    NEARLY_ALL,
    constants,
    levelling,
    powers,
    rising_share,
    spread,
    swept,
)
from pendula.ledger.row import checks, claim, runs, sweeps
from pendula.ledger.verdicts import Finding, judge, undecided
from pendula.studies.theory.bounds import proven_region, theorem_2_constants, widened_bound

# ASSUME: "whatever M" leaves out M < 10, where the ends are everywhere.
SHORTEST = 10
WINDOW = "[10, 50]"


@claim(
    "fig5_grows",
    "Section 5, Fig 5 right",
    "The maximal l2 norm grows nearly monotonically with M at Omega = 0.",
    sweeps("fig5_right"),
)
def l2_grows_with_m(sweep) -> Finding:
    """Fig 5, right: nearly monotonic growth of the maximal l2 in M at Omega = 0."""
    m, l2 = swept(sweep, "l2", "max", WINDOW)
    level = levelling(m, l2)
    rising = l2[: np.searchsorted(m, level) + 1] if np.isfinite(level) else l2
    measured = {"growth": l2[-1] / l2[0], "rising": rising_share(rising), "level_from": level}
    holds = measured["growth"] > FACTOR and measured["rising"] > NEARLY_ALL
    caveat = f"up to M = {level:.0f}, where it levels off" if np.isfinite(level) else ""
    return judge(measured, "growth > 2, 3 of 4 steps up", holds, caveat)


@claim(
    "fig5_conjecture",
    "Section 5, Fig 5 right",
    "This confirms growth on the unbounded lattice as time goes to infinity.",
    sweeps("fig5_right"),
)
def conjecture(sweep) -> Finding:
    """Fig 5, right: this confirms growth on the unbounded lattice as time goes to infinity."""
    m, l2 = swept(sweep, "l2", "max", WINDOW)
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


@claim(
    "fig5_maximum",
    "Section 5, Fig 5 right",
    "The l-infinity norm saturates to the same level whatever M.",
    sweeps("fig5_right"),
)
def maximum_independent_of_m(sweep) -> Finding:
    """Fig 5, right: l-infinity saturates to the same level whatever M."""
    m, linf = swept(sweep, "linf", "max", WINDOW)
    kept = linf[m >= SHORTEST] if np.any(m >= SHORTEST) else linf
    measured = {"spread": spread(kept), "mean": np.mean(kept)}
    return judge(measured, "spread for M >= 10 below 25 %", measured["spread"] < CHANGE)


@claim(
    "fig5_decreases",
    "Section 5, Fig 5 left",
    "At Omega = -4 the l2 norm decreases in M towards a level.",
    sweeps("fig5_left"),
)
def l2_decreases_with_m(sweep) -> Finding:
    """Fig 5, left: l2 decreases in M towards a level at Omega = -4, small data."""
    m, highest = swept(sweep, "l2", "max", WINDOW)
    _, average = swept(sweep, "l2", "mean", WINDOW)
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


@claim(
    "fig5_theorem_2",
    "Section 5, Fig 5 left",
    "The absence of growth agrees with Theorem 2.",
    (*runs("fig3_small"), *sweeps("fig5_left")),
)
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


@claim(
    "fig5_caption",
    "Fig 5, caption",
    "The norms shown are averages over [10, 50].",
    sweeps("fig5_left"),
)
def caption_of_fig_5(sweep) -> Finding:
    """Fig 5, caption: the norms are averaged over [10, 50]; then the text must hold for them."""
    _, average = swept(sweep, "l2", "mean", WINDOW)
    fall = 1.0 - average[-1] / average[0]
    fails = "the average does not decrease in M as the text says of this figure"
    return judge({"fall_of_mean": fall}, "the mean falls by > 2 %", fall > CONSTANT, fails=fails)


@claim(
    "fig5_not_shown",
    "Section 5, Fig 5",
    "A similar dependence (not shown) exists for Omega = 8.",
    checks("not_shown"),
)
def not_shown(check) -> Finding:
    """Fig 5: a similar dependence, not shown, for Omega = 8."""
    l2 = check["l2"].values
    level = levelling(check["half_width"].values, l2, CONSTANT)
    measured = {"fall": 1.0 - l2[-1] / l2[0], "level_from": level}
    return judge(measured, "l2 does not grow and levels off", l2[-1] <= l2[0] and level < np.inf)
