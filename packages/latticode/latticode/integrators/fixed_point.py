"""Implicit steps by fixed-point iteration, for the schemes of `crank_nicolson`.

A step solves new = base + factor G(new) for the new state. This module shares no step control or
error estimate with the explicit methods.

The iteration starts from a polynomial extrapolation of the last six steps. It stops when no number
changes by more than tolerance * |y|, where |y| is the largest number in the state at the previous
output. If the changes do not shrink, or are too large after the allowed number of iterations, the
step is halved until the iteration converges. Each halving is counted as a rejected step. If halving
does not help, the run ends with an error status.
"""

from collections.abc import Callable

import numpy as np

from latticode.kernels.compiled import copy, in_one_pass, kernel, uncached
from latticode.kernels.simd import largest_in_rows, zero_below

from . import DONE, INTERRUPTED, NO_CONTRACTION, NOT_FINITE, Outcome
from .rest import OF_STAGES, rest_level

Array = np.ndarray

PAST = 6
"""Number of increments from which the first guess is extrapolated."""
WORK = 4 + PAST
"""Number of work arrays of the size of a state."""
SAME = 1e-12
"""Steps count as equal up to this relative difference, because output times are rounded."""
SMALLEST_FRACTION = 2.0**-20
"""A step is not divided into fractions smaller than this."""


@kernel
def update(base: Array, factor: float, slope: Array, threshold: float, new: Array) -> float:
    """Set new = base + factor slope; return the largest change, or NaN if any change is NaN.

    `slope` is overwritten by the changes.
    """
    for row in range(base.shape[0]):
        for j in range(1, base.shape[1] - 1):
            value = zero_below(threshold, base[row, j] + factor * slope[row, j])
            slope[row, j] = abs(value - new[row, j])
            new[row, j] = value
    return largest_in_rows(slope, base.shape[0])


@kernel
def size(y: Array) -> float:
    """Return the largest absolute value in a state, without ghost columns."""
    largest = 0.0
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            largest = max(largest, abs(y[row, j]))
    return largest


@kernel
def extrapolate(old: Array, past: Array, latest: int, new: Array) -> None:
    """Write a guess into `new`: `old` plus an extrapolation of the last six increments.

    `latest` is the index of the newest increment in the ring buffer `past`. A polynomial of degree
    five has the binomial weights 6, -15, 20, -15, 6, -1. In the first six steps the missing
    increments are zero, which costs a few more iterations. Terms of equal sign are summed first.
    """
    a, b, c = past[latest], past[latest - 1], past[latest - 2]
    d, e, f = past[latest - 3], past[latest - 4], past[latest - 5]
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            odd = 6.0 * (a[row, j] + e[row, j]) + 20.0 * c[row, j]
            even = 15.0 * (b[row, j] + d[row, j]) + f[row, j]
            new[row, j] = old[row, j] + (odd - even)


@kernel
def accept(old: Array, new: Array, increment: Array) -> None:
    """Store the increment of this step for later guesses, and copy `new` to `old`."""
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            increment[row, j] = new[row, j] - old[row, j]
            old[row, j] = new[row, j]


@kernel
def is_finite(y: Array) -> bool:
    """Return whether all numbers of a state are finite."""
    for row in range(y.shape[0]):
        for j in range(y.shape[1]):
            if not abs(y[row, j]) < np.inf:
                return False
    return True


def build(begin: Callable, slope: Callable, observe: Callable) -> Callable:
    """Return the solver with the step new = base + factor G(new), defined by two functions.

    begin(system, old, h, follows, scratch) returns `base`, `factor` and the number of evaluations
    of the right-hand side that it made. `base` may be in `scratch`. If the step `follows` a step of
    the same length, `scratch` still has the content from that step.
    slope(system, old, new, scratch, dy) writes G(new) into dy; its `scratch` is another array.

    The time between two outputs is divided into equal steps, none longer than `step`.
    """

    @uncached
    def iterate(system, old, new, h, threshold, follows, scratch, enough, most):
        """Iterate `new`; return whether it converged, and the number of evaluations."""
        base, factor, evaluations = begin(system, old, h, follows, scratch[0])
        last = np.inf
        for count in range(1, most + 1):
            slope(system, old, new, scratch[1], scratch[2])
            change = update(base, factor, scratch[2], threshold, new)
            if change <= enough:
                return True, evaluations + count
            # the first change depends on the guess and is no sign of convergence
            if not change < np.inf or (count > 2 and change >= last):
                return False, evaluations + count
            last = change
        return False, evaluations + most

    @uncached
    def halve(system, old, new, h, threshold, scratch, enough, most, stop):
        """Divide `h` into shorter steps, halved until the iteration converges.

        Return whether it converged, and the numbers of halvings and evaluations. There may be a
        million short steps, so each of them reads the flag `stop`.
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

    @in_one_pass
    def solve(system, y, times, controls, work, record, stop) -> Outcome:
        step, tolerance, most = controls
        new, scratch, past, threshold = work[0], work[1:4], work[4:], rest_level(y, OF_STAGES)
        next_past = steps = rejected = evaluations = 0
        last = 0.0  # length of the previous step; 0 if there was none, or if it was halved
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
