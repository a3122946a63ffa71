"""The explicit midpoint rule, whose error is its difference from Euler's method."""

from latticode.integrators.method import AdaptiveCost, Control, Method

WORK = 3
"""Work arrays of the size of a state."""


class Midpoint(Method):
    """The explicit midpoint rule with error control."""

    name, label, order = "midpoint", "midpoint rule", 2
    controls = {"rtol": Control(1e-6, at_most=0.1), "atol": Control(1e-6)}
    cost = AdaptiveCost(0.7, 2, step_seconds=1e-7, pair_seconds=2e-8, pair_bytes=100)
    tightest = 1e-6


def build(rates, observe, at_time=None):
    """Return the solver of y' = rates; each step ends at an output or before it."""
    import numpy as np
    from latticode.integrators import DONE, INTERRUPTED, Outcome
    from latticode.kernels.compiled import at_any_time, in_one_pass, uncached

    at_time = at_time or at_any_time

    @uncached
    def move(y, h, slope, target):
        for row in range(y.shape[0]):
            for j in range(1, y.shape[1] - 1):
                target[row, j] = y[row, j] + h * slope[row, j]

    @uncached
    def relative_error(y, h, first, middle, rtol, atol):
        error = 0.0
        for row in range(y.shape[0]):
            for j in range(1, y.shape[1] - 1):
                scale = atol + rtol * abs(y[row, j])
                error = max(error, abs(h * (middle[row, j] - first[row, j])) / scale)
        return error

    @in_one_pass
    def solve(system, y, times, controls, work, record, stop):
        rtol, atol = controls
        first, middle, w = work[0], work[1], work[2]
        t, h, steps, rejected = times[0], 1e-3 * (times[1] - times[0]), 0, 0
        observe(system, y, np.int64(0), record)
        for i in range(1, times.size):
            while t < times[i]:
                if stop[0]:
                    return Outcome(INTERRUPTED, t, steps, rejected, 2 * (steps + rejected))
                step = min(h, times[i] - t)
                rates(at_time(system, t), y, first)
                move(y, 0.5 * step, first, w)
                rates(at_time(system, t + 0.5 * step), w, middle)
                error = relative_error(y, step, first, middle, rtol, atol)
                if error <= 1.0:
                    t = times[i] if step == times[i] - t else t + step
                    move(y, step, middle, y)
                    steps += 1
                else:
                    rejected += 1
                h = step * min(2.0, max(0.3, 0.9 / np.sqrt(error + 1e-10)))
            observe(system, y, np.int64(i), record)
        return Outcome(DONE, t, steps, rejected, 2 * (steps + rejected))

    return solve
