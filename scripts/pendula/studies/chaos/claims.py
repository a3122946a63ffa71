"""What the paper says of chaotic figures, of ensembles in place of single runs.

One run is one draw, and what it shows need not hold for the next. Here the same sentences, by the
same measures, are put to runs from data that differ in their last digits.
"""

import numpy as np

from pendula.ledger.claim import CHANGE, FACTOR, FEWEST, NEARLY_ALL, checks, claim, halves, late
from pendula.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    NeverLevels,
    UndecidableError,
    judge,
    undecided,
)
from pendula.measures.levels import APART, levelling_of_means, relative_range

SECTION = 5

NEEDS = checks("ensembles")


def followed(ensembles, case: str, norm: str, quantile: float = 0.5):
    """Return a quantile of a norm of the pair over the late times of a case."""
    if case not in ensembles["case"].values:
        raise UndecidableError(f"there is no ensemble of {case}")
    return late(ensembles[norm].sel(case=case, quantity="pair", quantile=quantile))


def swept(ensembles, sweep: str, norm: str, window: str):
    """Return (half-widths, means, standard errors) of the maxima of a sweep over a window."""
    if ensembles.sizes["half_width"] < FEWEST or window not in ensembles["window"].values:
        raise UndecidableError("the ensemble has fewer than six half-widths, or not the window")
    chosen = {"sweep": sweep, "quantity": "pair", "statistic": "max", "window": window}
    kept = ensembles.sel(chosen)
    return kept["half_width"].values, kept[f"{norm}_mean"].values, kept[f"{norm}_error"].values


@claim(
    "Section 5, Fig 3 lower, in an ensemble",
    "The central pendulum excites large oscillations of others and l2 grows.",
    NEEDS,
)
def ensemble_fig3(ensembles) -> Finding:
    start = float(ensembles["l2"].sel(case="fig3_large", quantity="pair", quantile=0.5)[0])
    first, second = halves(followed(ensembles, "fig3_large", "l2", 0.05))
    measured = {"first_half": first.mean() / start, "second_half": second.mean() / start}
    says = "lower band of l2 over the start"
    return judge(measured, Above(FACTOR, "second_half", says=says))


@claim(
    "Section 5, Fig 4, in an ensemble",
    "Growth stabilises at a certain level of the l-infinity norm.",
    NEEDS,
)
def ensemble_fig4_settles(ensembles) -> Finding:
    changes = {}
    for size in ("small", "large"):
        first, second = halves(followed(ensembles, f"fig4_{size}", "linf"))
        changes[f"change_{size}"] = abs(float(second.mean() / first.mean()) - 1.0)
    return judge(changes, Below(CHANGE, *changes, says="change between halves"))


@claim(
    "Section 5, Fig 4, in an ensemble",
    "There are no visible differences between the upper and lower panels.",
    NEEDS,
)
def ensemble_fig4_alike(ensembles) -> Finding:
    small, large = (
        [followed(ensembles, f"fig4_{size}", "l2", q) for q in (0.05, 0.5, 0.95)]
        for size in ("small", "large")
    )
    overlap = float(((small[0] <= large[2]) & (large[0] <= small[2])).mean())
    change = abs(float(large[1].mean() / small[1].mean()) - 1.0)
    measured = {"l2": change, "overlap_of_bands": overlap}
    caveat = f"the bands of nine runs in ten overlap {overlap:.0%} of the time"
    criterion = Below(CHANGE, "l2", says="difference of the late medians of l2")
    return judge(measured, criterion, caveat if overlap < 1.0 else "")


@claim(
    "Section 5, Fig 5 right, in an ensemble",
    "The maximal l2 norm grows nearly monotonically with M at Omega = 0.",
    NEEDS,
)
def ensemble_fig5_grows(ensembles) -> Finding:
    m, l2, error = swept(ensembles, "fig5_right", "l2", "[10, 50]")
    steps = np.diff(l2) / np.hypot(error[1:], error[:-1])
    level = levelling_of_means(m, l2, error, least=2)
    measured = {
        "growth": l2[-1] / l2[0],
        "rising": np.mean(steps > APART),
        "least_step": steps.min(),
        "level_from": level,
    }
    caveat = f"up to M = {level:.0f}, where it levels off" if np.isfinite(level) else ""
    criterion = AllOf(
        Above(FACTOR, "growth"),
        Above(NEARLY_ALL, "rising", says=f"share of steps up by > {APART:g} standard errors"),
        Above(-APART, "least_step", says="least step over its standard error"),
    )
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, Fig 5 right, in an ensemble",
    "The l-infinity norm saturates to the same level whatever M.",
    NEEDS,
)
def ensemble_fig5_maximum(ensembles) -> Finding:
    _, linf, error = swept(ensembles, "fig5_right", "linf", "[10, 50]")
    measured = {
        "relative_range": relative_range(linf),
        "mean": linf.mean(),
        "largest_error": error.max(),
    }
    return judge(measured, Below(CHANGE, "relative_range", says="range over mean"))


@claim(
    "Section 5, Fig 6 right, in an ensemble",
    "At Omega = -4, large data, the maximal l2 norm grows with M.",
    NEEDS,
)
def ensemble_fig6_grows(ensembles) -> Finding:
    m, l2, error = swept(ensembles, "fig6_right", "l2", "[10, 70]")
    peak = int(np.argmax(l2))
    ratio = l2[peak] / l2[0]
    noise = APART * ratio * float(np.hypot(error[peak] / l2[peak], error[0] / l2[0]))
    measured = {"peak_over_first": ratio, "two_errors": noise, "peak_at": m[peak]}
    if abs(ratio - FACTOR.value) <= noise:
        return undecided(
            measured, f"{ratio:.2f} is told from {FACTOR.value:g} by less than its error"
        )
    return judge(measured, Above(FACTOR, "peak_over_first"))


@claim(
    "Section 5, Fig 6 right, in an ensemble",
    "It apparently diverges as N goes to infinity.",
    NEEDS,
)
def ensemble_fig6_diverges(ensembles) -> Finding:
    m, l2, error = swept(ensembles, "fig6_right", "l2", "[10, 70]")
    level = levelling_of_means(m, l2, error)
    measured = {"level_from": level, "last": l2[-1], "error": error[-1], "largest": l2.max()}
    fails = f"from M = {level:.0f} on all means are the same to two standard errors"
    return judge(measured, NeverLevels("level_from"), fails=fails)
