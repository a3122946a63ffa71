"""What this project says beyond the paper about chaos and trust; the same rules hold for it."""

import numpy as np

from pendula.ledger.changes import roll
from pendula.ledger.chaos import chaotic
from pendula.ledger.claim import CHANGE, Control, checks, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff
from pendula.measures.confidence import student
from pendula.measures.growth import PARTS
from pendula.numerics.elementary import exp, log

from .claims import LATER

SECTION = 7
PLACE = "Beyond the paper"

SAME = Cutoff(3.0, "two measured numbers are the same up to three standard errors of both")


def chaotic_cases(lyapunov) -> np.ndarray:
    """Return the names of the chaotic cases; without any, a claim on them cannot be decided."""
    found = lyapunov["case"].values[chaotic(lyapunov).values]
    if not len(found):
        raise UndecidableError("no case is chaotic")
    return found


@claim(
    PLACE,
    "Perturbations that are odd in n grow as fast as even ones.",
    checks("lyapunov"),
    controls=(
        Control(
            "odd exponents of one case with even exponents of another",
            roll("exponent", {"case": 1}, parity="even"),
        ),
    ),
)
def odd_as_even(lyapunov) -> Finding:
    """Ask by how much they differ in the mean over the chaotic cases.

    A single case has an error from a few parts of one run, and chance decides which part is large.
    """
    chosen = lyapunov.sel(case=chaotic_cases(lyapunov))
    even, odd = (chosen["exponent"].sel(parity=parity) for parity in ("even", "odd"))
    mean = chosen["exponent"].mean("parity")
    off = float((abs(odd - even) / mean).mean())
    errors = (chosen["exponent_error"] / mean).values
    limit = student(PARTS - 1) * np.sqrt(np.sum(errors**2)) / chosen.sizes["case"]
    measured = {
        "difference": np.abs(even - odd).max(),
        "mean_difference": off,
        "at_least": max(0.0, off - limit),
        "at_most": off + limit,
    }
    says = "upper confidence limit of the mean relative difference of the exponents"
    criterion = Below(CHANGE, "at_most", says=says)
    if measured["at_least"] < CHANGE.value <= measured["at_most"]:
        return undecided(measured, "the runs are too short to decide whether the exponents differ")
    return judge(measured, criterion, fails=f"they differ by {100 * off:.2g} % on average")


def with_kinds_exchanged(members):
    """Return the members with the widths of even ensembles as those of uneven ones."""
    inverse = {
        "width_ratio": 1.0 / members["width_ratio"],
        "width_ratio_low": 1.0 / members["width_ratio_high"],
        "width_ratio_high": 1.0 / members["width_ratio_low"],
    }
    return members.assign(inverse)


@claim(
    PLACE,
    "Ensembles that are symmetric in n scatter sqrt(2) times as much as those that are not.",
    checks("members", "lyapunov"),
    controls=(Control("the two kinds exchanged", {"members": with_kinds_exchanged}),),
)
def even_bands_wider(members, lyapunov) -> Finding:
    if members["window"].values[-1] != LATER:
        raise UndecidableError(f"the bands are not those on {LATER}")
    chosen = members.sel(case=chaotic_cases(lyapunov))
    # One case alone does not resolve the root of two: its 32 members leave 10 to 25 % on the ratio.
    ratio = log(chosen["width_ratio"].values)
    limits = [log(chosen[f"width_ratio_{end}"].values) for end in ("low", "high")]
    quantile = student(members.sizes["member"] - 1)
    errors = 0.5 * (limits[1] - limits[0]) / quantile
    error = np.sqrt(np.square(errors).sum()) / errors.size
    measured = {
        f"ratio_{case}": chosen["width_ratio"].sel(case=case) for case in chosen["case"].values
    }
    measured["mean_ratio"] = exp(ratio.mean())
    measured["lower_limit"] = exp(ratio.mean() - quantile * error)
    measured["off"] = abs(ratio.mean() - 0.5 * log(2.0)) / error
    criterion = AllOf(
        Above(1.0, "lower_limit", says="lower confidence limit of the mean ratio of widths"),
        Below(SAME, "off", says="distance of the mean from sqrt(2), in standard errors"),
    )
    return judge(measured, criterion)
