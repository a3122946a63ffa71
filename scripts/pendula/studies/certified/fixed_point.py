"""A solution of (4) as polynomials with integer coefficients, in units of 2^-bits.

The initial data are even in n. The solution is even too, because the reflected chain has the same
equations and data, and solutions are unique. So the sites 0 to M are enough, with u_{-1} = u_1.

The interval between two outputs is divided into equal steps, and in each step the curve is a
polynomial in theta = (tau - start of the step) / step. A step starts from the sum of the
coefficients of the step before, which is also an integer, so the curve has no jumps.

`generate_steps` computes the curve; the proof does not depend on how. `require_full_interval`
checks that the steps between two outputs cover the interval exactly. `bound_jump` bounds the
distance from the start of a step to the end of the step before, or to the initial data.
`bound_defect` bounds the defect i p' - F(p) of the curve p, where (4) is i u' = F(u). Let the step
be 1 / H, q a common denominator of the constants, P = 2^bits p, and L the linear part of F. Then

    2 q H 4^bits i P'(theta) - 2 q 4^bits L P - q |P|^2 P

has integer coefficients, and is the defect times the step in units of 8^-bits / (2 q H). Products
of integer polynomials give it without rounding. The sum of the coefficients' absolute values bounds
the integral of the defect's l2 norm over the step, because theta^k <= 1 and an l2 norm is at most
an l1 norm.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import chain as joined
from math import lcm
from operator import mul
from typing import Any, NamedTuple

import numpy as np
from flint import fmpz_poly

from pendula.problem import PaperProblem

UP = 1.0 + 1e-9
"""This factor makes a computed sum or product of positive numbers an upper bound of the exact one,
if it has fewer than a million roundings: 1e6 * 2^-53 < 1e-9."""

LAST_TERM = 16
"""A step is shortened if the last coefficient of its polynomials is larger than this integer."""
MOST_STEPS = 64
"""Largest number of steps between two outputs."""

IntegerSeries = list[list[list[int]]]
"""Coefficients of the powers of theta: [Re or Im][site of A, then of B][power]."""


class NotEvenError(ValueError):
    """The problem is not even in n, and cannot be integrated on half of the chain."""


class StepError(ArithmeticError):
    """The steps do not reach from one output to the next."""


class FixedPointChain(NamedTuple):
    """Half of a chain: exact constants, sites, output interval and the bits of its integers."""

    epsilon: Fraction
    gamma: Fraction
    omega: Fraction
    sites: int
    interval: Fraction  # between two outputs, in tau
    bits: int  # integers are in units of 2^-bits


class Step(NamedTuple):
    """One polynomial of the curve, over a step of interval / divisor."""

    divisor: int
    terms: IntegerSeries


def decimal(x: float) -> Fraction:
    """Return the decimal that Python prints for this double, exactly: 1/10 for 0.1."""
    return Fraction(repr(float(x)))


def make_half_chain(problem: PaperProblem, bits: int) -> FixedPointChain:
    """Return half of the chain of a problem. Raises NotEvenError if its data are not even."""
    amplitudes = problem.amplitudes
    if problem.boundary != "dirichlet" or (amplitudes != amplitudes[:, ::-1]).any():
        raise NotEvenError(
            "a proof requires initial data that are even in n, and boundary: dirichlet"
        )
    constants = problem.constants
    epsilon, gamma, omega = map(decimal, (constants.epsilon, constants.gamma, constants.omega))
    interval = decimal(problem.output_step)
    return FixedPointChain(epsilon, gamma, omega, problem.half_width + 1, interval, bits)


def round_initial_data(
    problem: PaperProblem, chain: FixedPointChain
) -> tuple[list[list[int]], float]:
    """Return the initial data as integers and a bound of their l2 error.

    The integers are [Re or Im][site of A, then of B].
    """
    half = problem.amplitudes[:, problem.half_width :]
    state, error = [], Fraction(0)
    for component in (half.real, half.imag):
        exact = [decimal(x) * 2**chain.bits for x in component.ravel()]
        state.append([round(x) for x in exact])
        error += sum(abs(x - y) for x, y in zip(exact, state[-1], strict=True))
    return state, round_up_product(error, Fraction(1, 2**chain.bits))


def round_up_product(count: Fraction | int, unit: Fraction) -> float:
    """Return an upper bound, as a double, of the product of two numbers that are not negative."""
    return UP * float(count * unit)


def generate_steps(
    state: list[list[int]], chain: FixedPointChain, order: int
) -> Iterator[list[Step]]:
    """Yield the steps from each output to the next.

    Raises StepError if MOST_STEPS between two outputs are too few.
    """
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
            divisor -= 1  # the last terms of longer steps would also have been small enough


def evaluate_end(terms: IntegerSeries) -> list[list[int]]:
    """Return the exact state at the end of a step."""
    return [[sum(series) for series in row] for row in terms]


def make_taylor_terms(
    state: list[list[int]], chain: FixedPointChain, step: Fraction, order: int
) -> IntegerSeries:
    """Return the Taylor coefficients of one step from `state`, for theta^0 to theta^order."""
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


def scaled_linear(
    values: Sequence[Sequence[Any]], chain: FixedPointChain
) -> tuple[int, list[list]]:
    """Return q, and q times the linear terms of (4); `values` are integers or fmpz_poly."""
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
    """Return an upper bound of the integral of the defect's l2 norm over a step."""
    h = chain.interval / step.divisor
    x, y = ([fmpz_poly(series) for series in row] for row in step.terms)
    q, field = scaled_linear([x, y], chain)
    # the expression in the module's docstring, with the denominator of h as H; the numerator of h
    # multiplies L P and |P|^2 P
    shift, total = 4**chain.bits, 0
    for n, (re, im) in enumerate(zip(x, y, strict=True)):
        square = (re * re + im * im) * (q * h.numerator)
        for rate, value, row in ((-im.derivative(), re, 0), (re.derivative(), im, 1)):
            linear = rate * (2 * q * h.denominator) - field[row][n] * (2 * h.numerator)
            residual = linear * shift - square * value
            total += sum(map(abs, residual.coeffs()))
    unit = Fraction(1, 2 * q * h.denominator * 8**chain.bits)
    return round_up_product(int(total), unit)


def require_full_interval(steps: list[Step]) -> list[Step]:
    """Return the steps. Raises StepError unless they cover the interval between outputs exactly."""
    if any(step.divisor < 1 for step in steps) or sum(Fraction(1, s.divisor) for s in steps) != 1:
        raise StepError("the steps do not add up to the time between two outputs")
    return steps


def bound_jump(state: list[list[int]], after: Step, chain: FixedPointChain) -> float:
    """Return an upper bound of the l2 distance from a state to the start of a step."""
    ends = zip(joined(*state), joined(*after.terms), strict=True)
    return round_up_product(
        sum(abs(last - series[0]) for last, series in ends), Fraction(1, 2**chain.bits)
    )


def as_doubles(step: Step, chain: FixedPointChain) -> np.ndarray:
    """Return the coefficients rounded to doubles, (order, Re or Im, component, site)."""
    coefficients = [
        [[value / 2**chain.bits for value in series] for series in row] for row in step.terms
    ]
    return np.moveaxis(np.array(coefficients), 2, 0).reshape(-1, 2, 2, chain.sites)
