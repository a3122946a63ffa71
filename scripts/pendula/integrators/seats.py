"""Who sits in which lane: independent runs that go on side by side, each at its own pace.

Structured arrays, for tuples of arrays would be counted at each access, and that takes longer than
the work.
"""

import numpy as np

from pendula.compiled import merged
from pendula.vectors import LANES

from .outcome import DONE, NOT_FINITE, STEP_TOO_SMALL
from .taylor_step import allowed_step, up_to

SEAT = np.dtype(
    [
        ("run", np.int64),  # who sits there, or EMPTY
        ("output", np.int64),  # the next
        ("steps", np.int64),  # those taken
        ("time", np.float64),
        ("step", np.float64),
        ("offset", np.float64),  # from `time` to the output, where it is due
    ]
)
ENDED = np.dtype([("status", np.int64), ("time", np.float64), ("steps", np.int64)])
"""What became of a run: members of its `Outcome`."""
EMPTY = -1


@merged
def choose_step(seat, sizes, end, shortest, controls, ended):
    """Write the step of a lane, zero where it is empty or its run cannot go on."""
    seat.step = 0.0
    if seat.run == EMPTY:
        return
    h = allowed_step(sizes, controls[0], controls[1])
    seat.steps += 1
    if h > shortest:
        seat.step = up_to(h, end - seat.time)
    else:
        ended[seat.run].status = STEP_TOO_SMALL if h <= shortest else NOT_FINITE


@merged
def time_after(seat, end):
    """Return the time after the step."""
    return end if seat.step == end - seat.time else seat.time + seat.step


@merged
def goes_on(seat, ended):
    """Return whether there is a run, and has not been given up."""
    return seat.run != EMPTY and ended[seat.run].status == DONE


@merged
def is_due(seat, times, ended):
    """Return whether there is an output in the step."""
    if not goes_on(seat, ended) or seat.output == times.size:
        return False
    return times[seat.output] <= time_after(seat, times[-1])


@merged
def some_run(seats):
    """Return whether any lane has a run."""
    found = False
    for lane in range(LANES):
        found |= seats[lane].run != EMPTY
    return found


@merged
def find_outputs(seats, times, ended):
    """Write how far the next output of each lane is, if due; return whether any is."""
    found = False
    for lane in range(LANES):
        seat = seats[lane]
        due = is_due(seat, times, ended)
        seat.offset = times[seat.output] - seat.time if due else 0.0
        found |= due
    return found


@merged
def has_ended(seat, times, ended):
    """Carry the clock past the step; return whether the run ends there, and note how."""
    if seat.run == EMPTY:
        return False
    if goes_on(seat, ended):
        seat.time = time_after(seat, times[-1])
        if seat.output < times.size:
            return False
    ended[seat.run].time, ended[seat.run].steps = seat.time, seat.steps
    return True
