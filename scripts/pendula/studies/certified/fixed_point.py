"""A solution of (4) as polynomials whose coefficients are integers in units of 2^-bits.

The data are even in n, and so is the solution: the chain and its reflection have the same equation
and data, and solutions are unique. So the sites 0 to M are enough, with u_{-1} = u_1.

Each time between two outputs is cut into equal steps, and in each step the curve is a polynomial in
theta = (tau - start of the step) / step. A step begins with the sum of the coefficients of the one
before, which is an integer as well, so that the curve has no jumps.

`generate_steps` finds the curve, and no proof rests on it. `require_full_interval` requires that the steps between two
outputs cover this time exactly; `bound_jump` measures how far the start of a step is from the end of the
one before, or from the data; and `bound_defect` measures exactly what a polynomial misses of (4). With
step = 1 / H and q a common denominator of the constants, the numbers

    2 q H 4^bits i P'(theta) - 2 q 4^bits L P - q |P|^2 P,

P being the integer polynomials and L the linear part of (4), are integers: they are those of
i p' - F(p), times the step, in units of 8^-bits / (2 q H). They are found by products of integer
polynomials, without rounding, and the sum of their absolute values bounds the integral of the l2
norm of the defect over the step, since theta^k <= 1 and an l2 norm is no larger than a sum.
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import chain as joined
from math import lcm
from operator import mul
from typing import NamedTuple

import numpy as np
from flint import fmpz_poly

from pendula.problem import Problem

UP = 1.0 + 1e-9
"""Sums and products of positive numbers, with fewer than a million roundings, times this are upper
bounds: 1e6 * 2^-53 < 1e-9."""

LAST_TERM = 16
"""The last term of a polynomial is no larger than so many units, or the step becomes shorter."""
MOST_STEPS = 64
"""Steps between two outputs, at most."""

IntegerSeries = list[list[list[int]]]
"""By part, and site after site of A, then of B: the coefficients of the powers of theta."""


class NotEvenError(ValueError):
    """The problem is none on half of a chain."""


class StepError(ArithmeticError):
    """The steps do not lead from one output to the next."""


class FixedPointChain(NamedTuple):
    """Half of a chain: its constants, exactly, and the units of its numbers."""

    epsilon: Fraction
    gamma: Fraction
    omega: Fraction
    sites: int
    interval: Fraction  # between two outputs
    bits: int


class Step(NamedTuple):
    """A polynomial of the curve: step = interval / pieces."""

    divisor: int
    terms: IntegerSeries


def decimal(x: float) -> Fraction:
    """Return the printed decimal that a double stands for: 1/10 for 0.1."""
    return Fraction(repr(float(x)))


def make_half_chain(problem: Problem, bits: int) -> FixedPointChain:
    """Return the half of a chain with even data; raises NotEvenError for any other problem."""
    amplitudes = problem.amplitudes
    if problem.boundary != "dirichlet" or (amplitudes != amplitudes[:, ::-1]).any():
        raise NotEvenError(
            "a proof needs data that are even in n, on a chain at rest beyond its ends"
        )
    constants = problem.constants
    epsilon, gamma, omega = map(decimal, (constants.epsilon, constants.gamma, constants.omega))
    interval = decimal(problem.output_step)
    return FixedPointChain(epsilon, gamma, omega, problem.half_width + 1, interval, bits)


def round_initial_data(problem: Problem, chain: FixedPointChain) -> tuple[list[list[int]], float]:
    """Return the data in units, (part, site of A, then of B), and how far they are off in l2."""
    half = problem.amplitudes[:, problem.half_width :]
    state, error = [], Fraction(0)
    for component in (half.real, half.imag):
        exact = [decimal(x) * 2**chain.bits for x in component.ravel()]
        state.append([round(x) for x in exact])
        error += sum(abs(x - y) for x, y in zip(exact, state[-1], strict=True))
    return state, round_up_product(error, Fraction(1, 2**chain.bits))


def round_up_product(count: Fraction | int, unit: Fraction) -> float:
    """Return an upper bound of a number that is not negative."""
    return UP * float(count * unit)


def generate_steps(
    state: list[list[int]], chain: FixedPointChain, order: int
) -> Iterator[list[Step]]:
    """Yield the steps from each output to the next; raises StepError."""
    divisor = 1
    while True:
        steps: list[Step] = []
        current = state
        while len(steps) < divisor:
            terms = make_taylor_terms(current, chain, chain.interval / divisor, order)
            largest = max(abs(series[-1]) for row in terms for series in row)
            if largest > LAST_TERM:
                divisor, steps, current = divisor + 1, [], state
                if divisor > MOST_STEPS:
                    raise StepError(f"{MOST_STEPS} steps between outputs are too few")
                continue
            steps.append(Step(divisor, terms))
            current = evaluate_end(terms)
        yield steps
        state = current
        last_term = max(abs(series[-1]) for step in steps for row in step.terms for series in row)
        if max(last_term, 1) * divisor**order <= LAST_TERM * (divisor - 1) ** order:
            divisor -= 1  # longer steps would have done, judged by their last terms


def evaluate_end(terms: IntegerSeries) -> list[list[int]]:
    """Return the state at the end of a step, exactly."""
    return [[sum(series) for series in row] for row in terms]


def make_taylor_terms(
    state: list[list[int]], chain: FixedPointChain, step: Fraction, order: int
) -> IntegerSeries:
    """Return the terms of one step."""
    bits, count = chain.bits, 2 * chain.sites
    re_series, im_series = ([[value] for value in row] for row in state)
    halves: list[list[int]] = [[] for _ in range(count)]
    for k in range(order):
        q, exact = scaled_linear(
            [[series[k] for series in re_series], [series[k] for series in im_series]], chain
        )
        factor = step / (k + 1)
        for n in range(count):
            re, im, half = re_series[n], im_series[n], halves[n]
            square = sum(map(mul, re, re[::-1])) + sum(map(mul, im, im[::-1]))
            half.append(square >> (bits + 1))
            reversed_half = half[::-1]
            real = exact[0][n] // q + (sum(map(mul, reversed_half, re)) >> bits)
            imaginary = exact[1][n] // q + (sum(map(mul, reversed_half, im)) >> bits)
            # i A' = F: Re A' = Im F and Im A' = -Re F
            re.append(imaginary * factor.numerator // factor.denominator)
            im.append(-real * factor.numerator // factor.denominator)
    return [re_series, im_series]


def scaled_linear(values, chain: FixedPointChain) -> tuple[int, list[list]]:
    """Return q and q times the linear terms of (4), for integers or polynomials of integers."""
    q = lcm(chain.epsilon.denominator, chain.gamma.denominator, chain.omega.denominator)
    epsilon, gamma, omega = (int(q * c) for c in (chain.epsilon, chain.gamma, chain.omega))
    sites, results = chain.sites, []
    for row, drive in zip(values, (gamma, -gamma), strict=True):
        scaled = []
        for n, value in enumerate(row):
            site = n % sites
            left = row[n - 1] if site else (row[n + 1] if sites > 1 else 0)
            right = row[n + 1] if site < sites - 1 else 0
            partner = row[n - sites] if n >= sites else row[n + sites]
            total = (left + right) * epsilon + value * (omega - 2 * epsilon - drive)
            scaled.append(total + partner * drive)
        results.append(scaled)
    return q, results


def bound_defect(step: Step, chain: FixedPointChain) -> float:
    """Return a bound of the integral of the defect's l2 norm over a step."""
    h = chain.interval / step.divisor
    x, y = ([fmpz_poly(series) for series in row] for row in step.terms)
    q, field = scaled_linear([x, y], chain)
    # with h = top / bottom all is multiplied by bottom, and the linear and cubic terms by top
    shift, total = 4**chain.bits, 0
    for n, (own_x, own_y) in enumerate(zip(x, y, strict=True)):
        square = (own_x * own_x + own_y * own_y) * (q * h.numerator)
        for change, own, row in ((-own_y.derivative(), own_x, 0), (own_x.derivative(), own_y, 1)):
            slope = change * (2 * q * h.denominator) - field[row][n] * (2 * h.numerator)
            missed = slope * shift - square * own
            total += sum(map(abs, missed.coeffs()))
    unit = Fraction(1, 2 * q * h.denominator * 8**chain.bits)
    return round_up_product(int(total), unit)


def require_full_interval(steps: list[Step]) -> list[Step]:
    """Return the steps if they cover the time between two outputs exactly; raises StepError."""
    if any(step.divisor < 1 for step in steps) or sum(Fraction(1, s.divisor) for s in steps) != 1:
        raise StepError("the steps between two outputs are more or less than the time between them")
    return steps


def bound_jump(state: list[list[int]], after: Step, chain: FixedPointChain) -> float:
    """Return a bound of the l2 distance from a state to the start of a step."""
    ends = zip(joined(*state), joined(*after.terms), strict=True)
    return round_up_product(
        sum(abs(last - series[0]) for last, series in ends), Fraction(1, 2**chain.bits)
    )


def as_doubles(step: Step, chain: FixedPointChain) -> np.ndarray:
    """Return the terms as nearest doubles, (order, part, component, site)."""
    coefficients = [
        [[value / 2**chain.bits for value in series] for series in row] for row in step.terms
    ]
    return np.moveaxis(np.array(coefficients), 2, 0).reshape(-1, 2, 2, chain.sites)
