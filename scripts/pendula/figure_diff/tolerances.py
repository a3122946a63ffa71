"""The tolerances of the comparison, each with its reason: the one place where they stand.

The bands were found by moving epsilon by its last bit (2e-16), and in another run the tolerances of
the solvers by 1e-9 to 1e-7 of them, and making everything anew: each is two to five times what
these changed, where not said otherwise, and holds the spread of the tails of three solvers.
"""

from fnmatch import fnmatchcase
from typing import NamedTuple

Bands = tuple[float | None, float | None, float | None]
"""Of mean, standard deviation and maximum beyond the horizon, relative; None leaves one out."""


class Rule(NamedTuple):
    """How curves are compared whose label (see `curves`) matches a pattern."""

    pattern: str
    """One or several, with | between them."""
    method: str
    """pointwise, chaotic (pointwise up to a horizon, then by statistics) or magnitude."""
    limit: float
    """Of the largest value of the curve; for magnitude, in decades."""
    reason: str
    horizon: float = 0.0
    bands: Bands = (None, None, None)
    below: float = float("inf")
    """The rule is for curves whose largest value is smaller than this."""


EARLY, LATE = 8.0, 20.0
"""Horizons of trust in tau: a last bit grows by 1.8 (Omega = 0) and 2.65 (Omega = -4, large, late)
per unit of tau, so 2e-16 is still below 1e-9 there; by 15 and 25 it has passed 1e-6."""

STEADY: Bands = (0.1, 0.7, 0.25)
WILD: Bands = (0.5, 1.0, 0.5)
FREE: Bands = (0.3, 0.4, 0.5)
RISING: Bands = (0.15, None, 0.2)


def _observed(case: str) -> str:
    names = ("ratio", "observed", "backwards", "steepest")
    return "|".join(f"*:{name} case={case}" for name in names)


def _spreads() -> str:
    files = ("lyapunov", "ensembles", "growth_law", "front", "window_map")
    return "|".join(f"*/{file}:*{word}*" for file in files for word in ("error", "deviation"))


RULES = [
    Rule("*", "magnitude", 1, "rounding errors, residuals of solvers: their size", below=1e-8),
    Rule("*:true_*", "pointwise", 1e-6, "committed references: to the last digit, chaos or not"),
    # parameters and times fit none of the rules for chaos, which name what they are for
    Rule("*/fig3_large*:energy", "pointwise", 1e-4, "constant, but for the drift of a chaotic run"),
    Rule("*/fig4_*:energy", "pointwise", 5e-3, "the same, and H itself is small"),
    Rule("*/fig3_large*:l*|*/fig3_large*:modulus*", "chaotic", 1e-6, "a chaotic run", LATE, WILD),
    Rule("*/fig3*:l*=large*|*/fig3*:modulus*=large*", "chaotic", 1e-6, "as drawn", LATE, WILD),
    Rule("*/fig4*:l*|*/fig4*:modulus*", "chaotic", 1e-6, "runs and figures", EARLY, STEADY),
    Rule("*/fig5_right*:l*|*/fig5:l*=right*", "chaotic", 1e-6, "from chaotic tails", 0, RISING),
    Rule("*/fig6_right*:l*|*/fig6:l*=right*", "chaotic", 1e-6, "the same, wilder", 0, WILD),
    Rule("*observed sweep=fig5_right", "chaotic", 1e-6, "squares of the same", 0, (0.3, None, 0.4)),
    Rule("*observed sweep=fig6_right", "chaotic", 1e-6, "squares of the same", 0, (1, None, 1)),
    Rule("checks/sweeps:excess", "pointwise", 0.5, "the largest of the same"),
    Rule(_observed("fig3_large"), "pointwise", 1.0, "squared maximum of a chaotic tail"),
    Rule(_observed("fig4_*"), "pointwise", 0.5, "squared maximum of a chaotic tail"),
    Rule("*:drift case=fig3_large*|*:drift case=fig4_*", "magnitude", 1, "depends on the path"),
    Rule("*/energy_drift:drift*", "pointwise", 1e-3, "small differences (1e-6) of large numbers"),
    # errors as parts of full scale, which for a chaotic curve is the maximum of its tail
    Rule("*/trust*:difference case=fig3_large*", "chaotic", 1, "of a chaotic scale", 0, WILD),
    Rule("*/trust*:difference case=fig4_*", "chaotic", 1, "of a chaotic scale", 0, FREE),
    Rule("*:difference case=fig3_large*", "chaotic", 0.3, "of a chaotic scale", EARLY, WILD),
    Rule("*:difference case=fig4_*", "chaotic", 0.3, "of a chaotic scale", EARLY, FREE),
    # ensembles and exponents of chaotic runs, chains without ends: samples of the same distribution
    Rule("*/hard_cases:seconds*", "magnitude", 3, "times of a machine"),
    Rule(_spreads(), "magnitude", 1.5, "spreads of a few chaotic samples"),
    Rule("*/lyapunov:*", "pointwise", 0.3, "means along chaotic runs"),
    Rule("*/symmetry:*", "chaotic", 1, "odd parts that grow from rounding", 0, WILD),
    Rule("*/ensembles:*", "pointwise", 0.4, "quantiles and means of chaotic samples"),
    Rule("*/growth_law:*|*/front:*|*/window_map:*", "pointwise", 0.6, "the same, of few members"),
    Rule("*:difference *", "pointwise", 1e-3, "small differences (1e-6) of norms"),
    Rule("*:parting *", "pointwise", 0.03, "a step of output, or of the scale of a chaotic curve"),
    Rule("*:horizon *", "pointwise", 0.25, "chance decides which rounding grows: 0.19 was seen"),
    Rule("*", "pointwise", 1e-6, "regular: other roundings give 1e-9, single precision 6e-8"),
]
"""First match counts. A label reads `figures/fig3:l2 amplitude=large component=A`."""

FLOOR = 1e-12
"""Errors below this are all alike: sums of roundings, which another library may order otherwise."""


def rule_for(label: str, largest: float) -> Rule:
    """Return the first rule for a curve of this label and largest value; the last one fits all."""
    fitting = (rule for rule in RULES if largest < rule.below or rule.below == float("inf"))
    return next(
        rule
        for rule in fitting
        if any(fnmatchcase(label, pattern) for pattern in rule.pattern.split("|"))
    )


class Limits(NamedTuple):
    """How much two pictures may differ."""

    shade: int = 3
    """Pixels that differ by no more, of 255, are equal: the rounding of blended colours."""
    pixels: float = 1e-4
    """Part of the pixels that may differ, where the environment is that of the baseline: a curve
    that moved by a rounding error may cross from one pixel to the next."""
    look: float = 0.35
    """Local unlikeness (0 same, 1 nothing in common), where it is not: other letters and shifts by
    a pixel reach 0.26 in the figures of this project, a lost label or swapped colours 0.9."""
    totals: float = 0.35
    """Change of the ink of a cell, where the curves were compared by statistics: the tail of a
    chaotic curve takes 0.1 to 0.2, a lost label or curve 0.4 and more."""


LIMITS = Limits()
