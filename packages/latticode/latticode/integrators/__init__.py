"""Time integrators: one file a method, one calling convention. None knows a model.

    build(rates, observe) -> solve
    solve(system, y, times, controls, work, record, stop) -> Outcome

`rates(system, y, dy)` is the right-hand side (`crank_nicolson.build_conserving` takes its mean over
a step, Taylor the rule of a power series), `observe(system, y, i, record)` reduces the state at
output i. `work` holds as many arrays of the size of `y` as the module's WORK says. `y` holds pairs
of rows (real and imaginary parts) with one ghost column at each side; it starts as the initial
state and ends as the final one. `times` are those of the outputs, from the start on. Nothing is
allocated in the step loop. Another thread may raise the flag `stop`, an array of one boolean: the
loop reads it at every step and ends (see latticode.simulation.interrupts).

A system may depend on time. `build` of the methods that can follow one takes `at_time(system, t)`,
which returns the system as it is at the time t and is asked before every call of `rates`, or once a
step for a power series. Rounding lets t + h miss the time that a step of h reaches. Only what
depends on time can tell, and there steps are rounded so that t + h is exact.

Every explicit method measures errors by the largest component and takes the same steps whether a
solution that is even in n is given whole or by half. Its loop counts outputs by `i`, and steps to
`t_new`, past one output or several, which it interpolates.
"""

from typing import NamedTuple

DONE, STEP_TOO_SMALL, NOT_FINITE, NO_CONTRACTION, INTERRUPTED = range(5)
"""The status of a run."""

FAULTS = {
    STEP_TOO_SMALL: "the step fell below what rounding or the length of the run allows",
    NOT_FINITE: "the state is no longer finite",
    NO_CONTRACTION: "the fixed-point iteration did not contract even at the smallest step",
    INTERRUPTED: "it was interrupted",
}
"""What a status other than DONE means, in words."""

SMALLEST_PART = 1e-10
"""A step shorter than this part of the run is refused."""


class Outcome(NamedTuple):
    """Status, the time reached, and counts of the work done."""

    status: int
    time: float
    steps: int  # taken
    rejected: int  # tried in vain; for a fixed-point iteration how often a step was halved
    evaluations: int  # of the right-hand side; of the orders of a series for Taylor
