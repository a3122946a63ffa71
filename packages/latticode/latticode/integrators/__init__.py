"""Time integrators with a common calling convention, each in its own file and free of any model.

    build(rates, observe) -> solve
    solve(system, y, times, controls, work, record, stop) -> Outcome

`rates(system, y, dy)` is the right-hand side. Instead, `crank_nicolson.build_conserving` takes its
mean over a step, and `taylor.build` the rule of a power series. `observe(system, y, i, record)`
stores the observables of output i. `y` (row, column) is the initial state, and the final state
overwrites it. Each field has two rows, its real and imaginary parts, with a ghost at each end.
`work` holds WORK arrays of the size of `y`. `times` are the start and the output times. Nothing is
allocated in the step loop. `stop` is an array of one boolean, which another thread may set: the
loop reads it at every step and then ends (see latticode.simulation.interrupts).

For equations that depend on time, `build` takes `at_time(system, t)`, which returns the system at
time t. It is called before every call of `rates`, or once per step for a power series. In floating
point t + h - t may differ from h. With `at_time` the step is rounded to t + h - t, which is the
difference of the times at which the equations are evaluated.

Every explicit method measures errors by the largest component. It therefore takes the same steps on
half of a chain that is even in n. Its loop steps to `t_new` and interpolates all outputs `i` that
this step has passed.
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
"""Messages for the statuses other than DONE."""

SMALLEST_PART = 1e-10
"""Shortest step that is allowed, as a fraction of the length of the run."""


class Outcome(NamedTuple):
    """How a run ended: its status, the time reached, and the numbers of steps and evaluations."""

    status: int
    time: float
    steps: int  # accepted steps
    rejected: int  # rejected steps; for a fixed-point iteration the number of halvings
    evaluations: int  # of the right-hand side; for Taylor, of orders of the series
