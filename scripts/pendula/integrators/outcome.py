"""How a run ended and what it cost."""

from typing import NamedTuple

DONE, STEP_TOO_SMALL, NOT_FINITE, NO_CONTRACTION, STEP_TOO_LONG = range(5)

MOST_STEPS = 1e9
"""More steps are refused: the run would take hours or never end."""
SMALLEST_PART = 1e-10
"""A step shorter than this part of the run is refused."""

FAULTS = {
    STEP_TOO_SMALL: "the step fell below what rounding or the length of the run allows",
    NOT_FINITE: "the state is no longer finite",
    NO_CONTRACTION: "the fixed-point iteration did not contract even at the smallest step",
    STEP_TOO_LONG: "the step is too long for amplitudes that large, or they are not finite",
}


class Outcome(NamedTuple):
    """Status, the time reached, and counts of the work done."""

    status: int
    time: float
    steps: int
    rejected: int
    evaluations: int
