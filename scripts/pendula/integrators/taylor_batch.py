"""The Taylor method for many runs at once: each lane of the vectors holds a run of its own.

A chain of a few sites fills no vector, four of them do. A lane has its own time and its own step
and does what `taylor` does for its run alone, to the last bit; when that is done it takes the next.
"""

import numpy as np

from pendula.compiled import copy, generic, inlined
from pendula.vectors import LANES

from .outcome import SMALLEST_PART
from .seats import EMPTY, find_outputs, has_ended, is_due, some_run
from .taylor_lanes import choose_steps, empty_lane, evaluate, step_on, write_lane


def build(single, take_seat, continue_batch, observe):
    """Return the solver of many systems of one kind, from states `runs` (run, row, column).

    `single(systems, run)` is the system of one run, `take_seat(systems, run, lane)` gives a lane
    its parameters, `continue_batch(systems, series)` writes the series of all lanes. Output `i` of
    a run is observed as output run * times.size + i.
    """

    @generic
    def sit_down(systems, runs, run, lane, times, work, record):
        """Let a lane begin a run, or a state at rest where there is none left; return the next."""
        seat = work.seats[lane]
        if run == runs.shape[0]:
            seat.run = EMPTY
            empty_lane(work.series, lane)
            return run
        seat.run, seat.time, seat.output, seat.steps = run, times[0], 1, 0
        take_seat(systems, run, lane)
        write_lane(runs[run], work.series, lane)
        observe(single(systems, run), runs[run], run * times.size, record)
        return run + 1

    @generic
    def write_outputs(systems, runs, times, work, record, ended):
        """Observe what falls into the steps of the lanes; the last of each run stays in `runs`."""
        while find_outputs(work.seats, times, ended):
            evaluate(work.series, work.seats, work.states)
            for lane in range(LANES):
                seat = work.seats[lane]
                if is_due(seat, times, ended):
                    run = seat.run
                    copy(work.states[lane], runs[run])
                    observe(single(systems, run), runs[run], run * times.size + seat.output, record)
                    seat.output += 1

    @inlined
    def solve(systems, runs, times, controls, work, record, ended):
        series, seats = work.series, work.seats
        end, shortest = times[-1], SMALLEST_PART * (times[-1] - times[0])
        waiting = np.int64(0)
        for lane in range(LANES):
            waiting = sit_down(systems, runs, waiting, lane, times, work, record)
        while some_run(seats):
            continue_batch(systems, series)
            choose_steps(series, seats, end, shortest, controls, ended)
            write_outputs(systems, runs, times, work, record, ended)
            step_on(series, seats)
            for lane in range(LANES):
                if has_ended(seats[lane], times, ended):
                    waiting = sit_down(systems, runs, waiting, lane, times, work, record)

    return solve
