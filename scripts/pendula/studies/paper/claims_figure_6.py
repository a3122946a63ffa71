"""Fig 6: maxima and means over windows against the half-width M, large data.

On a fixed window no norm can diverge with M: by (19) the norm on the infinite chain is finite,
and once the front does not reach the ends, a longer chain changes nothing.
"""

import numpy as np

from pendula.ledger.readings import CONSTANT, FACTOR, constants, levelling, powers, spread, swept
from pendula.ledger.row import claim, runs, sweeps
from pendula.ledger.verdicts import Finding, judge, undecided
from pendula.studies.theory.bounds import theorem_1_bound, theorem_2_constants

# ASSUME: a maximum that falls to 90 % of the peak has fallen back.
FALLEN = 0.9
WINDOW, CAPTION = "[10, 70]", "[10, 40]"


@claim(
    "fig6_constant",
    "Section 5, Fig 6 left",
    "At Omega = 8 the maximal l2 norm does not change with N.",
    sweeps("fig6_left"),
)
def independent_of_m(sweep) -> Finding:
    """Fig 6, left: the maximal l2 does not change with N at Omega = 8, large data."""
    _, l2 = swept(sweep, "l2", "max", WINDOW)
    return judge({"spread": spread(l2)}, "spread < 2 %", spread(l2) < CONSTANT)


@claim(
    "fig6_theorem_1",
    "Section 5, Fig 6 left",
    "This agrees with Theorem 1.",
    (*runs("fig2_large"), *sweeps("fig6_left")),
)
def bounded_by_theorem_1(case, sweep) -> Finding:
    """Fig 6, left: in agreement with Theorem 1."""
    bound = float(theorem_1_bound(float(case["energy"][0]), constants(case)))
    ratio = float(sweep["l2"].sel(quantity="pair").max()) ** 2 / bound
    return judge({"ratio": ratio}, "largest P over C <= 1", ratio <= 1.0)


@claim(
    "fig6_grows",
    "Section 5, Fig 6 right",
    "At Omega = -4, large data, the maximal l2 norm grows with M.",
    sweeps("fig6_right"),
)
def large_data_grow_with_m(sweep) -> Finding:
    """Fig 6, right: the maximal l2 grows with M at Omega = -4, large data."""
    m, l2 = swept(sweep, "l2", "max", WINDOW)
    peak = int(np.argmax(l2))
    measured = {"peak_over_first": l2[peak] / l2[0], "peak_at": m[peak], "last": l2[-1] / l2[peak]}
    caveat = ""
    if measured["last"] < FALLEN:
        caveat = f"up to M = {m[peak]}; beyond it falls back to {measured['last']:.2f} of the peak"
    return judge(measured, "peak over first > 2", measured["peak_over_first"] > FACTOR, caveat)


@claim(
    "fig6_diverges",
    "Section 5, Fig 6 right",
    "It apparently diverges as N goes to infinity.",
    sweeps("fig6_right"),
)
def large_data_diverge(sweep) -> Finding:
    """Fig 6, right: it apparently diverges as N goes to infinity."""
    m, l2 = swept(sweep, "l2", "max", WINDOW)
    level = levelling(m, l2)
    measured = {"level_from": level, "last": l2[-1], "largest": l2.max()}
    fails = f"it is level from M = {level:.0f} on, as it must be on a fixed window"
    return judge(measured, "no level", not np.isfinite(level), fails=fails)


@claim(
    "fig6_not_technical",
    "Section 5, Fig 6 right",
    "That Theorem 2 is limited to small data is not a technical shortfall.",
    (*runs("fig3_large"), *sweeps("fig6_right")),
)
def not_technical(case, sweep) -> Finding:
    """Fig 6, right: large data leave the bound of Theorem 2, so that its limitation is real."""
    m, l2 = swept(sweep, "l2", "max", WINDOW)
    c_0 = theorem_2_constants(constants(case))[1]
    start = float(powers(case)[0])
    measured = {"P_over_delta": l2[-1] ** 2 / start, "C_0": c_0, "longest_chain": m[-1]}
    caveat = "growth without bound in time is not decided by a fixed window"
    return judge(measured, "P over delta > C_0", measured["P_over_delta"] > c_0, caveat)


@claim(
    "fig6_caption",
    "Fig 6, caption",
    "The norms shown are averages over [10, 40].",
    sweeps("fig6_left", "fig6_right"),
)
def caption_of_fig_6(left, right) -> Finding:
    """Fig 6, caption: averages over [10, 40] rather than maxima over [10, 70]."""
    readings = (("max", WINDOW), ("mean", CAPTION))
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
