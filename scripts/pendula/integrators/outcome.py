"""How a run ended and what it cost; and which steps no method takes."""

from typing import NamedTuple

DONE, STEP_TOO_SMALL, NOT_FINITE, NO_CONTRACTION, STEP_TOO_LONG = range(5)
"""The status of a run."""

FAULTS = {
    STEP_TOO_SMALL: "the step fell below what rounding or the length of the run allows",
    NOT_FINITE: "the state is no longer finite",
    NO_CONTRACTION: "the fixed-point iteration did not contract even at the smallest step",
    STEP_TOO_LONG: "the step is too long for amplitudes that large, or they are not finite",
}
"""What a status other than DONE means, in words."""

MOST_STEPS = 1e9
"""More steps are refused: the run would take hours or never end."""
SMALLEST_PART = 1e-10
"""A step shorter than this part of the run is refused."""


class Outcome(NamedTuple):
    """Status, the time reached, and counts of the work done."""

    status: int
    time: float
    steps: int  # taken
    rejected: int  # tried in vain; for Crank-Nicolson how often a step was halved
    evaluations: int  # of the right-hand side; of the orders of a series for Taylor
