"""Implicit steps by fixed-point iteration: what the schemes of `crank_nicolson` share.

All solve new = base + part G(new) for the new state, see `crank_nicolson`. They share no step
control and no error estimate with the explicit methods.

The iteration starts from the extrapolation of the last six steps by a polynomial, and stops when
the largest change of a part (real or imaginary) falls below tolerance * |y|, where |y| is the
largest part at the last output. Where the changes do not shrink, or not far enough within the
allowed count, the step is halved until they do: each halving is counted as a rejected step, and the
run ends with a fault where halving does not help.
"""

import numpy as np

from latticode.kernels.compiled import copy, inlined_by_numba, kernel, uncached
from latticode.kernels.simd import largest_in_rows, zero_below

from . import DONE, INTERRUPTED, NO_CONTRACTION, NOT_FINITE, Outcome
from .rest import OF_STAGES, rest_level

PAST = 6
"""Increments that the first guess is extrapolated from."""
WORK = 4 + PAST
"""Work arrays of the size of a state."""
SAME = 1e-12
"""Steps whose lengths differ by this part are one length, since times of outputs are rounded."""
SMALLEST_FRACTION = 2.0**-20
"""The part of a step below which halving it is given up."""


@kernel
def update(base, fraction, slope, threshold, new):
    """Set new = base + part slope; return the largest change of a part, NaN where there is one.

    `slope` is overwritten by the changes.
    """
    for row in range(base.shape[0]):
        for j in range(1, base.shape[1] - 1):
            value = zero_below(threshold, base[row, j] + fraction * slope[row, j])
            slope[row, j] = abs(value - new[row, j])
            new[row, j] = value
    return largest_in_rows(slope, base.shape[0])


@kernel
def size(y):
    """Return the largest absolute value of a part."""
    largest = 0.0
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            largest = max(largest, abs(y[row, j]))
    return largest


@kernel
def extrapolate(old, past, latest, new):
    """Guess `new` from the last six increments; `latest` is the place of the newest in the ring.

    A polynomial of degree five through six increments gives the next one the binomial weights
    6, -15, 20, -15, 6, -1. Before six steps are taken the missing increments are zero: the guess is
    worse, which costs a few iterations. Terms of one sign are summed first, in pairs.
    """
    a, b, c = past[latest], past[latest - 1], past[latest - 2]
    d, e, f = past[latest - 3], past[latest - 4], past[latest - 5]
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            odd = 6.0 * (a[row, j] + e[row, j]) + 20.0 * c[row, j]
            even = 15.0 * (b[row, j] + d[row, j]) + f[row, j]
            new[row, j] = old[row, j] + (odd - even)


@kernel
def accept(old, new, increment):
    """Keep the increment of this step for later guesses, and move `old` on to `new`."""
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            increment[row, j] = new[row, j] - old[row, j]
            old[row, j] = new[row, j]


@kernel
def is_finite(y):
    """Return whether no part of `y` is infinite or NaN."""
    for row in range(y.shape[0]):
        for j in range(y.shape[1]):
            if not abs(y[row, j]) < np.inf:
                return False
    return True


def build(begin, slope, observe):
    """Return the solver whose step, new = base + part G(new), two functions describe.

    begin(system, old, h, follows, scratch) returns `base` and `part`, which are then kept for all
    iterations of the step, and how many right-hand sides that took. `base` may be `scratch`, which
    holds what it held after the step before if this step `follows` one of the same length.
    slope(system, old, new, scratch, dy) writes G(new) into dy; its `scratch` is another array.

    The distance between two outputs is covered in equal steps, none longer than `step`.
    """

    @uncached
    def iterate(system, old, new, h, threshold, follows, scratch, enough, most):
        """Iterate `new` to the solution; return whether it contracted, and the evaluations."""
        base, factor, evaluations = begin(system, old, h, follows, scratch[0])
        last = np.inf
        for count in range(1, most + 1):
            slope(system, old, new, scratch[1], scratch[2])
            change = update(base, factor, scratch[2], threshold, new)
            if change <= enough:
                return True, evaluations + count
            # the first change is that of the guess, which may be anything
            if not change < np.inf or (count > 2 and change >= last):
                return False, evaluations + count
            last = change
        return False, evaluations + most

    @uncached
    def halve(system, old, new, h, threshold, scratch, enough, most, stop):
        """Cover `h` in equal parts, halved until the iteration contracts.

        Return whether that worked, the number of halvings, and the evaluations. A step may be cut
        into a million parts, so the flag is read at each of them.
        """
        fraction, covered = 0.5, 0.0
        halvings, evaluations = 1, 0
        while covered < 1.0 and not stop[0]:
            copy(old, new)
            short_step = fraction * h
            good, count = iterate(
                system, old, new, short_step, threshold, False, scratch, enough, most
            )
            evaluations += count
            if good:
                copy(new, old)
                covered += fraction
            else:
                fraction *= 0.5
                halvings += 1
                if fraction < SMALLEST_FRACTION:
                    return False, halvings, evaluations
        return True, halvings, evaluations

    @inlined_by_numba
    def solve(system, y, times, controls, work, record, stop):
        step, tolerance, most = controls
        new, scratch, past, threshold = work[0], work[1:4], work[4:], rest_level(y, OF_STAGES)
        next_past = steps = rejected = evaluations = 0
        last = 0.0  # length of the step before; 0 if there was none, or if it was halved
        for i in range(times.size):
            span = times[i] - times[max(i - 1, 0)]
            step_count = int(np.ceil(span / step * (1.0 - 1e-12)))
            enough = tolerance * size(y)
            for step_number in range(step_count):
                h = span / step_count
                extrapolate(y, past, next_past - 1, new)
                follows = abs(h - last) <= SAME * h
                good, count = iterate(
                    system, y, new, h, threshold, follows, scratch, enough, int(most)
                )
                evaluations += count
                if good:
                    accept(y, new, past[next_past])
                    next_past, last = (next_past + 1) % PAST, h
                else:
                    good, halvings, count = halve(
                        system, y, new, h, threshold, scratch, enough, int(most), stop
                    )
                    rejected, last = rejected + halvings, 0.0
                    evaluations += count
                if stop[0] or not good:
                    fault = NO_CONTRACTION if is_finite(y) else NOT_FINITE
                    status = INTERRUPTED if stop[0] else fault
                    at = times[i - 1] + step_number * span / step_count
                    return Outcome(status, at, steps, rejected, evaluations)
                steps += 1
            observe(system, y, i, record)
        return Outcome(DONE, times[-1], steps, rejected, evaluations)

    return solve
