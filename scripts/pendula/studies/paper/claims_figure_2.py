"""Fig 2: norms against time at Omega = 8."""

import numpy as np

from pendula.ledger.readings import CHANGE, FACTOR, MUCH, constants, halves, late, mean, powers
from pendula.ledger.row import claim, runs
from pendula.ledger.verdicts import Finding, judge
from pendula.studies.theory.bounds import theorem_1_bound

# ASSUME: "decreases": to less than half; "oscillates between": squares of norms correlated below
# -0.8; "effectively separated": three quarters of A are kept.
HALF, ANTICORRELATED, KEPT = 0.5, -0.8, 0.75


@claim(
    "fig2_bounded",
    "Section 5, Fig 2",
    "The simulation confirms the global bound of Theorem 1 at Omega = 8.",
    runs("fig2_small", "fig2_large"),
)
def bounded_by_theorem_1(small, large) -> Finding:
    """Fig 2: Theorem 1 bounds l2 at Omega = 8."""
    ratios = [
        powers(ds).max() / theorem_1_bound(float(ds["energy"][0]), constants(ds))
        for ds in (small, large)
    ]
    measured = dict(zip(("small", "large"), ratios, strict=True))
    return judge(measured, "largest P over C <= 1", max(ratios) <= 1.0)


@claim(
    "fig2_centre",
    "Section 5, Fig 2 upper",
    "The oscillation of the central pendulum decreases.",
    runs("fig2_small"),
)
def centre_decreases(small) -> Finding:
    """Fig 2, upper: the amplitude of the central pendulum decreases."""
    a = late(small)["linf"].sel(component="A").max() / small["linf"].sel(component="A")[0]
    return judge({"largest_late_amplitude": a}, "late over initial < 0.5", a < HALF)


@claim(
    "fig2_exchange",
    "Section 5, Fig 2 upper",
    "The l2 norm oscillates between A and B.",
    runs("fig2_small"),
)
def modes_exchange(small) -> Finding:
    """Fig 2, upper: l2 oscillates between A and B."""
    a, b = late(small)["l2"].values ** 2
    with np.errstate(invalid="ignore"):  # constant norms have no correlation
        correlation, swing = np.corrcoef(a, b)[0, 1], float(np.ptp(a) / np.mean(a))
    measured = {"correlation": correlation, "swing_of_A": swing}
    holds = correlation < ANTICORRELATED and swing > CHANGE
    return judge(measured, "correlation of |A|^2, |B|^2 < -0.8, swing > 25 %", holds)


@claim(
    "fig2_maxima",
    "Section 5, Fig 2 upper",
    "The l-infinity norms of A and B are comparable and change little.",
    runs("fig2_small"),
)
def maxima_comparable(small) -> Finding:
    """Fig 2, upper: l-infinity of A and B are comparable and change little after a while."""
    first, second = halves(small)
    ratio = mean(late(small), "linf", "A") / mean(late(small), "linf", "B")
    change = max(abs(mean(second, "linf", k) / mean(first, "linf", k) - 1.0) for k in "AB")
    measured = {"ratio": ratio, "change": change}
    holds = 1 / FACTOR < ratio < FACTOR and change < CHANGE
    return judge(measured, "ratio within 2, change between halves < 25 %", holds)


@claim(
    "fig2_separate",
    "Section 5, Fig 2 lower",
    "The motion of A is effectively separated from that of B.",
    runs("fig2_large"),
)
def modes_separate(large) -> Finding:
    """Fig 2, lower: A moves apart from B."""
    settled = late(large)
    share = settled["linf"].sel(component="A") / large["linf"].sel(component="A")[0]
    ratio = settled["l2"].sel(component="B").max() / settled["l2"].sel(component="A").min()
    measured = {"smallest_A_kept": share.min(), "B_over_A": ratio}
    holds = measured["smallest_A_kept"] > KEPT and ratio < 1.0 / MUCH
    return judge(measured, "A keeps 75 % of its maximum, l2 of B below a third of A", holds)


@claim(
    "fig2_alone",
    "Section 5, Fig 2 lower",
    "The central pendulum does not excite large oscillations of others.",
    runs("fig2_large"),
)
def centre_alone(large) -> Finding:
    """Fig 2, lower: the central pendulum does not excite large oscillations of others."""
    start = float(large["linf"].sel(component="A")[0])
    a = large.sel(component="A")
    others = np.sqrt(np.maximum(0.0, a["l2"] ** 2 - a["linf"] ** 2)).max() / start
    partner = large["linf"].sel(component="B").max() / start
    measured = {"all_other_A": others, "largest_B": partner}
    return judge(measured, "each below a third of A_0", max(others, partner) < 1.0 / MUCH)
