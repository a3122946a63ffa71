"""Fig 3: norms against time at Omega = -4."""

import numpy as np

from pendula.ledger.readings import FACTOR, MUCH, halves, largest, late, mean, powers
from pendula.ledger.row import claim, runs
from pendula.ledger.verdicts import Finding, judge

# ASSUME: a rise of 10 % is worth a caveat.
RISE = 0.1


@claim(
    "fig3_alike",
    "Section 5, Fig 3 upper",
    "For small data Omega = -4 shows no drastic difference to Omega = 8.",
    runs("fig2_small", "fig3_small"),
)
def like_omega_8(eight, four) -> Finding:
    """Fig 3, upper: no drastic difference to Omega = 8."""
    l2 = np.sqrt(powers(late(four)).mean() / powers(late(eight)).mean())
    linf = largest(late(four)).mean() / largest(late(eight)).mean()
    measured = {"l2_ratio": l2, "linf_ratio": linf}
    return judge(measured, "ratios within 2", all(1 / FACTOR < x < FACTOR for x in (l2, linf)))


@claim(
    "fig3_mix",
    "Section 5, Fig 3 lower",
    "A and B mix up.",
    runs("fig3_large"),
)
def modes_mix(large) -> Finding:
    """Fig 3, lower: A and B mix up."""
    _, second = halves(large)
    ratio = mean(second, "l2", "A") / mean(second, "l2", "B")
    initial = float(large["l2"].sel(component="A")[0] / large["l2"].sel(component="B")[0])
    measured = {"l2_ratio": ratio, "initial_ratio": initial}
    return judge(measured, "late ratio of l2 within 2", 1 / FACTOR < ratio < FACTOR)


@claim(
    "fig3_excited",
    "Section 5, Fig 3 lower",
    "The central pendulum excites large oscillations of others and l2 grows.",
    runs("fig3_large"),
)
def others_excited(large) -> Finding:
    """Fig 3, lower: l2 grows, since the central pendulum excites large oscillations of others."""
    _, second = halves(large)
    growth = np.sqrt(powers(second).mean() / powers(large)[0])
    sites = powers(second).mean() / np.mean(largest(second) ** 2)
    measured = {"l2_growth": growth, "pendula_in_motion": sites}
    return judge(measured, "l2 grows by 2, sites in motion > 3", growth > FACTOR and sites > MUCH)


@claim(
    "fig3_maximum",
    "Section 5, Fig 3 lower",
    "The l-infinity norm stays at the level of the initial data.",
    runs("fig3_large"),
)
def maximum_stays(large) -> Finding:
    """Fig 3, lower: l-infinity stays at the level of the initial data."""
    ratio = largest(late(large)) / largest(large)[0]
    measured = {"mean": ratio.mean(), "largest": ratio.max()}
    grown = measured["mean"] > 1.0 + RISE
    caveat = f"it rises by {100 * (measured['mean'] - 1):.0f} % on average" if grown else ""
    return judge(measured, "within a factor of 2", ratio.max() < FACTOR, caveat)
