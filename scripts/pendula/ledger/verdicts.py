"""Verdicts and what they rest on. A verdict is computed from numbers, never typed."""

from enum import StrEnum
from typing import NamedTuple

import numpy as np


class Verdict(StrEnum):
    """All that can be said of a sentence of the paper."""

    CONFIRMED = "confirmed"
    CAVEAT = "confirmed with a caveat"
    NOT_REPRODUCED = "not reproduced"
    UNDECIDED = "cannot be decided"


class UndecidableError(Exception):
    """Raised by a deciding function whose data do not suffice; the message says why."""


class Finding(NamedTuple):
    """What a claim was measured to be, against which tolerance, and what follows."""

    measured: dict[str, float]
    tolerance: str
    verdict: Verdict
    because: str


def judge(
    measured: dict, tolerance: str, holds, caveat: str = "", fails: str = "not within tolerance"
) -> Finding:
    """Return a finding: not reproduced, because it `fails`, unless it `holds`.

    A `caveat` that is not empty stays with what holds.
    """
    numbers = {name: float(value) for name, value in measured.items()}
    if not bool(holds):
        return Finding(numbers, tolerance, Verdict.NOT_REPRODUCED, fails)
    if caveat:
        return Finding(numbers, tolerance, Verdict.CAVEAT, caveat)
    return Finding(numbers, tolerance, Verdict.CONFIRMED, "")


def undecided(measured: dict, because: str) -> Finding:
    """Return a finding that no number at hand can settle."""
    numbers = {name: float(value) for name, value in measured.items()}
    return Finding(numbers, "", Verdict.UNDECIDED, because)


def within_tolerance(check, *names: str) -> Finding:
    """Return the finding of a check that holds when these variables keep their tolerances."""
    measured = {name: float(np.max(check[name].values)) for name in names}
    limits = {name: float(check[name].attrs["tolerance"]) for name in names}
    text = ", ".join(f"{name} <= {limit:.4g}" for name, limit in limits.items())
    return judge(measured, text, all(measured[name] <= limits[name] for name in names))


def number(check, name: str, **selection) -> float:
    """Return one number of a check's dataset."""
    return float(check[name].sel(selection).values)
