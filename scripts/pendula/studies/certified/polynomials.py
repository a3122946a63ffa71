"""A solution of (4) as Taylor polynomials in double precision, one for each step in time.

Nothing here needs to be exact: `regular` bounds the distance to the true solution afterwards, and
takes the polynomials as they are. So they may come from anywhere; those of the solver `taylor` have
the order 16, and a higher order makes what they leave out vanish beside rounding.

Every step has the length 2^-m. Times, products with the step, and the distance from the start of a
step to an output are then exact in double precision.
"""

from typing import NamedTuple

import numpy as np
from latticode.equations.ends import neighbours

from pendula.models.amplitudes import linear_field
from pendula.problem import Problem

ORDER = 20
"""The highest exponent of time in a polynomial."""
LEFT_OUT = 2.0**-52
"""The steps are so short that the last term is smaller than this part of the first."""
SHORTEST, LONGEST = 2.0**-20, 2.0**-4


class Curve(NamedTuple):
    """Polynomials in theta = (tau - start of the step) / step, from 0 to 1 in each step.

    `terms` has the shape (order, step, part, component, site): the real and the imaginary part of
    the coefficient of theta^order. Step j starts at tau = j * step.
    """

    step: float
    terms: np.ndarray


class StepError(ArithmeticError):
    """No step that is long enough makes the last term of the polynomials small."""


def find_curve(problem: Problem, order: int = ORDER) -> Curve:
    """Return polynomials up to the end of a problem; its solver is not used.

    Raises StepError where the steps would have to be shorter than SHORTEST.
    """
    step = LONGEST
    while step >= SHORTEST:
        terms = _try(problem, order, step)
        if terms is not None:
            return Curve(step, terms)
        step *= 0.5
    raise StepError(f"steps of {SHORTEST:g} are too long for polynomials of order {order}")


def _try(problem: Problem, order: int, step: float) -> np.ndarray | None:
    """Return the terms of all steps, nothing where the last term of one is too large."""
    amplitudes = problem.amplitudes
    count = int(np.ceil(problem.end_time / step))
    terms = np.empty((count, order + 1, 2, *amplitudes.shape))
    state = np.stack([amplitudes.real, amplitudes.imag])
    for own in terms:
        own[0] = state
        _continue(own, problem, step)
        if not np.abs(own[-1]).max() <= LEFT_OUT * np.abs(state).max():
            return None
        state = add_up(own)[0]
    return np.ascontiguousarray(terms.swapaxes(0, 1))


def _continue(own: np.ndarray, problem: Problem, step: float) -> None:
    """Write the terms of the orders 1 on of one step, (order, part, component, site)."""
    half_squares = np.empty((len(own), 1, *own.shape[2:]))
    for k in range(len(own) - 1):
        squares = np.add.reduce(own[: k + 1] * own[k::-1])
        half_squares[k] = 0.5 * (squares[0] + squares[1])
        cubic = np.add.reduce(half_squares[: k + 1] * own[k::-1])
        field = step * (linear(own[k], problem) + cubic)
        own[k + 1, 0] = field[1] / (k + 1)  # i A' = F: Re A' = Im F and Im A' = -Re F
        own[k + 1, 1] = -field[0] / (k + 1)


def linear(values: np.ndarray, problem: Problem) -> np.ndarray:
    """Return the linear terms of (4), (..., part, component, site) as `values`.

    A term of `values` goes through seven roundings at most, see `regular.LINEAR_ROUNDINGS`.
    """
    right, left = neighbours(values, problem.boundary)
    sides = {0: values, 1: right, -1: left}

    def seen(partner: int, part: int, by: int) -> np.ndarray:
        return sides[by][..., part, :: 1 - 2 * partner, :]

    return np.stack(linear_field(problem.constants, seen), axis=-3)


def add_up(terms: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the sum over the first axis, rounded, and what rounding left out to first order.

    Knuth's TwoSum gives the error of each addition exactly. The second number is the sum of these
    errors, itself rounded, less what the first took of it: sum = first + second, but for rounding
    errors of the errors.
    """
    total, rest = terms[-1], np.zeros_like(terms[0])
    for term in terms[-2::-1]:
        total, error = two_sum(total, term)
        rest = rest + error
    return two_sum(total, rest)


def two_sum(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return a + b, rounded, and its error, exactly (D. E. Knuth, TAOCP vol. 2, section 4.2.2)."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)
