"""How a run ended and what it cost."""

from typing import NamedTuple

DONE, STEP_TOO_SMALL, NOT_FINITE, NO_CONTRACTION = range(4)

FAULTS = {
    STEP_TOO_SMALL: "the step fell below the spacing of floating-point numbers",
    NOT_FINITE: "the state is no longer finite",
    NO_CONTRACTION: "the fixed-point iteration did not contract even at the smallest step",
}


class Outcome(NamedTuple):
    """Status, the time reached, and counts of the work done."""

    status: int
    time: float
    steps: int
    rejected: int
    evaluations: int
