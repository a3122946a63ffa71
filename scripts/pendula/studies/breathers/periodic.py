"""Periodic breathers: localised states that oscillate at a frequency lambda.

    A_n(tau) = sum over odd m of a_{n,m} exp(-i m lambda tau) with real coefficients,

and the same form for B_n. The equations (4) are reversible: if A(tau) is a solution, so is conj
A(-tau). They are odd: if A is a solution, so is -A. Real coefficients make A and B real at tau = 0,
and odd harmonics change sign after half a period T / 2 = pi / lambda; together they make A and B
imaginary at T / 4. Conversely, a solution that is real at 0 and imaginary at T / 4 is reflected at
both times, and so has the period T and both symmetries. A breather is therefore computed by
shooting over a quarter of its period: Newton's method solves Re A(T / 4) = Re B(T / 4) = 0 for the
real unknowns A(0), B(0), and needs only perturbations of these. P is even in time about both
instants, and decreases monotonically from the first to the second.

Module `multipliers` computes their stability.

Existence. On an infinite chain the tails decay if no odd multiple of lambda meets the frequencies
of linear waves, equation (15): with kappa between Omega - 4 epsilon and Omega, +-kappa for A + B
and +-sqrt(kappa^2 - 4 gamma^2) for A - B. This holds if lambda lies above all of them. The nearer
lambda is to the waves, the slower the tails decay, until they reach the end of a chain.

If A = B, the drive vanishes, and there are breathers at the frequencies of waves too:
A_n = phi_n exp(-i lambda tau) with the soliton phi of the scalar equation, for each lambda above
Omega. Then A - B vanishes, and the tails of A + B decay if lambda lies outside the band of A + B. P
tends to zero as lambda tends to Omega.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from latticode.localised.breathers import NoStateError
from latticode.numerics.matrices import times

from pendula.models.pairs import FAMILIES as PAIRS
from pendula.models.steady import localised
from pendula.problem import Constants

from .quarter_period import FINE_STEPS, STEPS, integrate_bundle

FAMILIES = ("A only", "A = -B", "A = B")
"""Families: "A only" has B = 0 at gamma = 0, and B grows with the drive; the others have B = -A or
B = A."""
EQUAL_PAIR = next(family for family in PAIRS if family.kind == "equal")
TOLERANCE = 1e-13
"""Largest |Re A| and |Re B| at a quarter of a period, relative to the largest amplitude at the
start."""
ITERATIONS = 30
EQUAL = 1e-6
"""A and B count as equal if they differ by less than this, relative to the largest amplitude."""


class Breather(NamedTuple):
    """A periodic breather at an instant at which A and B are real, (component, site 0..M)."""

    constants: Constants
    frequency: float
    data: np.ndarray

    @property
    def quarter(self) -> float:
        """A quarter of the period, in tau."""
        return 0.5 * np.pi / self.frequency


def highest_wave(constants: Constants) -> float:
    """Return the highest frequency of a linear wave, equation (15)."""
    return max(abs(constants.omega - 4.0 * constants.epsilon), abs(constants.omega))


def find_breather(
    family: str, constants: Constants, frequency: float, half_width: int
) -> Breather | None:
    """Return the breather of a family, or None if it has none above the linear waves.

    A breather "A only" that has become A = B does not count.
    """
    if frequency <= highest_wave(constants):
        return None
    start = single_site(constants, frequency, family, half_width)
    try:
        breather = shoot(constants, frequency, start)
    except NoStateError:
        return None
    a, b = breather.data
    ended = family == "A only" and np.abs(a - b).max() < EQUAL * np.abs(a).max()
    return None if ended else breather


def find_soliton(constants: Constants, frequency: float, half_width: int) -> Breather:
    """Return the soliton A = B of this frequency. Raises NoStateError if it is not above Omega."""
    turned = replace(constants, omega=constants.omega - frequency)
    problem, state = localised(EQUAL_PAIR, turned, half_width)
    phi = state.components(problem)[0, 0, half_width:]
    return Breather(constants, frequency, np.stack([phi, phi]))


def exchange_sign(data: np.ndarray) -> int:
    """Return 1 if A = B, -1 if A = -B, and 0 otherwise."""
    return next((sign for sign in (1, -1) if np.array_equal(data[0], sign * data[1])), 0)


def power(data: np.ndarray) -> np.ndarray:
    """Return the sum of squares of each component over the whole chain, (component,)."""
    return 2.0 * np.sum(data**2, axis=1) - data[:, 0] ** 2


def least_power(breather: Breather) -> float:
    """Return P at the instant when A and B are imaginary, its minimum over a period."""
    return float(power(quarter_later(breather, FINE_STEPS)[0, 1::2]).sum())


def single_site(constants: Constants, frequency: float, family: str, half_width: int) -> np.ndarray:
    """Return the first guess: the motion of one pair, and its neighbours to first order."""
    binding = frequency - constants.omega + 2.0 * constants.epsilon
    data = np.zeros((2, half_width + 1))
    data[0, :2] = np.sqrt(2.0 * binding) * np.array([1.0, constants.epsilon / binding])
    if family == "A only":
        data[1] = -constants.gamma / (frequency + constants.omega) * data[0]
    else:
        data[1] = data[0] if family == "A = B" else -data[0]
    return data


def shoot(constants: Constants, frequency: float, start: np.ndarray) -> Breather:
    """Return the breather to which Newton's method converges from real data (component, site).

    A start with A = B or A = -B keeps this symmetry to the last bit, even where the matrix does not
    determine the step that would break it. Raises NoStateError if the method does not converge.
    """
    data, sites, symmetry, largest = start, start.shape[1], exchange_sign(start), np.inf
    for _ in range(ITERATIONS):
        guess = Breather(constants, frequency, data)
        miss = quarter_later(guess, FINE_STEPS)[0, ::2]
        last, largest = largest, np.abs(miss).max() / np.abs(data).max()
        if largest <= TOLERANCE and largest >= 0.1 * last:
            return guess
        if not largest < 10.0:
            break
        equations = miss.ravel()[: sites * (1 if symmetry else 2)]
        step = -times(np.linalg.inv(_derivative_of_miss(guess, symmetry)), equations).reshape(
            -1, sites
        )
        data = data + (np.concatenate([step, symmetry * step]) if symmetry else step)
    raise NoStateError(f"no breather at the frequency {frequency:g}: residual {largest:.1e}")


def quarter_later(breather: Breather, steps: int, changes: np.ndarray | None = None) -> np.ndarray:
    """Return a breather and small perturbations of its data after a quarter of a period.

    `changes` are real, (change, component, site); the result is (1 + changes, 4, site), see
    `integrate_bundle`.
    """
    nothing = np.empty((0, 4, breather.data.shape[1]))
    evens = nothing if changes is None else real_data(changes)
    state = real_data(breather.data)
    return integrate_bundle(breather.constants, state, evens, nothing, breather.quarter, steps)


def _derivative_of_miss(guess: Breather, symmetry: int) -> np.ndarray:
    """Return the derivative of the miss by the data, or by the data of A if A = B or A = -B."""
    sites = guess.data.shape[1]
    unit = np.eye(sites)
    both = np.eye(2 * sites).reshape(-1, 2, sites)
    changes = np.stack([unit, symmetry * unit], axis=1) if symmetry else both
    ends = quarter_later(guess, STEPS, changes)
    return ends[1:, ::2].reshape(len(changes), -1)[:, : len(changes)].T


def real_data(data: np.ndarray) -> np.ndarray:
    """Return real amplitudes (..., component, M + 1) as states (..., 4, M + 1)."""
    state = np.zeros((*data.shape[:-2], 4, data.shape[-1]))
    state[..., ::2, :] = data
    return state
