"""Lemma 1 for the pendula: its limit in mu, its correction, and its sentence."""

from itertools import pairwise

import numpy as np
from latticode.numerics.elementary import log

from pendula.ledger.changes import scale
from pendula.ledger.claim import Control, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    UndecidableError,
    judge,
)
from pendula.ledger.cutoff import Cutoff

SECTION = 7
PLACE = "Section 3, Lemma 1, for the pendula (1)"
THRESHOLD = "pendula/threshold"

FIRST_DIGITS = Cutoff(1e-3, "equal in the first three digits")
ORDER = Cutoff(0.5, "an order counts as the nearest whole number")
FEWEST = 3
"""So many mu at least: through two points any two numbers make a line."""


def smallest_mus(dataset):
    """Return the dataset by falling mu; it must hold enough of them."""
    if dataset.sizes["mu"] < FEWEST:
        raise UndecidableError(f"a limit requires {FEWEST} values of mu")
    return dataset.isel(mu=np.argsort(-dataset["mu"].values))


def outside(dataset):
    """Return the detunings outside the band at which each mu has a threshold above zero."""
    some = (dataset["gamma_0"] > 0).all("mu") & (dataset["gamma_0_lemma"] > 0)
    if not some.any():
        raise UndecidableError("no detuning lies outside the band")
    return dataset.isel(omega=some.values)


def limit_of(dataset):
    """Return by detuning the threshold at mu = 0: the polynomial in mu^2 through all (Neville)."""
    row = list(dataset["gamma_0"].transpose("mu", "omega").values)
    squares = [mu * mu for mu in dataset["mu"].values]
    for k in range(1, len(row)):
        row = [
            new + (new - old) * (squares[i + k] / (squares[i] - squares[i + k]))
            for i, (old, new) in enumerate(pairwise(row))
        ]
    return row[0]


def order_between(larger, smaller, mus):
    """Return the order in mu of what is `larger` at mus[-2] and `smaller` at mus[-1]."""
    return log(np.asarray(larger) / np.asarray(smaller)) / log(mus[-2] / mus[-1])


def at_the_far_edge(dataset):
    """Return Lemma 1's thresholds with half of the distance of Omega from the far edge."""
    edge, lemma = 4.0 * dataset.attrs["epsilon"], dataset["gamma_0_lemma"]
    far = 0.5 * abs(dataset["omega"] - edge * (dataset["omega"] < 0))
    return dataset.assign(gamma_0_lemma=lemma.where(lemma == 0.0, far))


@claim(
    PLACE,
    "In the limit of small mu the pendula become unstable at the gamma_0 of Lemma 1.",
    (THRESHOLD,),
    (
        Control("thresholds at the far edge of the band", at_the_far_edge),
        Control("thresholds for half of the drive", scale("gamma_0_lemma", 2.0)),
    ),
)
def lemma_1_is_the_limit(threshold) -> Finding:
    """Continue the exact thresholds to mu = 0; inside the band they must be zero."""
    ordered = smallest_mus(threshold)
    beside = outside(ordered)
    off = limit_of(beside) / beside["gamma_0_lemma"] - 1.0
    inside = ordered["gamma_0"].sel(omega=(ordered["gamma_0_lemma"] == 0).values)
    measured = {
        "detunings": beside.sizes["omega"],
        "largest_difference": abs(off).max(),
        "largest_inside": inside.max() if inside.size else 0.0,
    }
    criterion = AllOf(
        Below(FIRST_DIGITS, "largest_difference", says="relative difference in the limit"),
        AtMost(0.0, "largest_inside", says="largest threshold within the band"),
    )
    return judge(measured, criterion)


@claim(
    PLACE,
    "The threshold of the pendula differs from that of Lemma 1 by gamma_0^2 mu^2 / 4: it is higher "
    "below the band and lower above it.",
    (THRESHOLD,),
    (
        Control(
            "the same sign on both sides",
            lambda one: one.assign(correction=abs(one["correction"])),
        ),
        Control("half of the coefficient", scale("correction", 0.5)),
    ),
)
def correction_of_the_threshold(threshold) -> Finding:
    """Take the order of what is left beside the term, between the two smallest mu."""
    beside = outside(smallest_mus(threshold))
    mu, below = beside["mu"], (beside["omega"] < 0).values
    if below.all() or not below.any():
        raise UndecidableError("all detunings lie on one side of the band")
    shift = beside["gamma_0"] - beside["gamma_0_lemma"]
    left = abs(shift - beside["correction"] * mu * mu)
    order = order_between(left.isel(mu=-2), left.isel(mu=-1), mu.values)
    measured = {
        "least_order": order.min(),
        "largest_order": order.max(),
        "least_shift_below": shift.sel(omega=below).min(),
        "largest_shift_above": shift.sel(omega=~below).max(),
    }
    says = "order in mu of the remaining difference"
    criterion = AllOf(
        Near(4.0, ORDER, "least_order", "largest_order", says=says),
        Above(0.0, "least_shift_below", says="shift of the threshold below the band"),
        Below(0.0, "largest_shift_above", says="shift of the threshold above the band"),
    )
    return judge(measured, criterion)


@claim(
    PLACE,
    "The pendula at rest are linearly stable if gamma is below the gamma_0 of Lemma 1.",
    (THRESHOLD,),
    (
        Control(
            "only detunings below the band",
            lambda one: one.sel(omega=((one["omega"] < 0) & (one["gamma_0"] > 0).all("mu")).values),
            confirms=True,
        ),
    ),
)
def lemma_1_for_the_pendula(threshold) -> Finding:
    """Compare the exact thresholds with Lemma 1's at each mu, where both are known."""
    lemma = threshold["gamma_0_lemma"]
    share = (threshold["gamma_0"] / lemma).where(lemma > 0)
    if not np.isfinite(share).any():
        raise UndecidableError("no detuning lies outside the band")
    above = share.sel(omega=(threshold["omega"] > 0).values)
    measured = {
        "least_share": share.min(),
        "largest_share": share.max(),
        "least_share_above": above.min() if above.size else np.nan,
    }
    says = "least threshold of the pendula over that of Lemma 1"
    criterion = AtLeast(1.0, "least_share", says=says)
    fails = (
        "above the band a drive weaker than gamma_0 makes the pendula unstable, and at large mu the"
        " second resonance does so below the band"
    )
    return judge(measured, criterion, fails=fails)
