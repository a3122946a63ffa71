"""Periodic breathers: localised states that oscillate at a frequency lambda.

    A_n(tau) = sum over odd m of a_{n,m} exp(-i m lambda tau) with real coefficients,

B_n alike. The equations (4) are reversible, conj A(-tau) solves them with A(tau), and odd, -A
solves them with A. Real coefficients make A and B real at tau = 0, odd harmonics turn their sign
after half a period T / 2 = pi / lambda, and both together make A and B imaginary at T / 4.
Conversely, a solution that is real at 0 and imaginary at T / 4 is reflected at both times, hence
has the period T and both symmetries. So a breather is found by shooting over a quarter of its
period: Re A(T / 4) = Re B(T / 4) = 0 for the real unknowns A(0), B(0), by Newton's method, which
needs the perturbations of these data alone.

Module `multipliers` computes their stability.

Existence. On an infinite chain the tails decay if no odd multiple of lambda meets the frequencies
of linear waves, equation (15): with kappa between Omega - 4 epsilon and Omega, +-kappa for A + B
and +-sqrt(kappa^2 - 4 gamma^2) for A - B. So lambda lies above all of them, or in a gap below. Into
the gap at Omega = -4, 2.7 to 3.5, "A only" and "A = -B" can be continued from gamma = 0, but they
end at gamma of 0.2 to 0.5 and 0.7 to 0.95. A = B does not feel the drive and has the one harmonic
lambda, which only has to lie above Omega.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from latticode.localised.breathers import NoStateError
from latticode.numerics.elementary import geometric, log
from latticode.numerics.matrices import times
from scipy.optimize import minimize_scalar

from pendula.problem import Constants

from .quarter_period import FINE_STEPS, STEPS, flow
from .waves import distance_from_bands, highest

FAMILIES = ("A only", "A = -B", "A = B")
"""B = 0 where gamma = 0, and follows by the drive; B opposite to A; B equal to A."""
TOLERANCE = 1e-13
"""Largest |Re A| and |Re B| at a quarter of a period, relative to the largest at the start."""
ITERATIONS = 30
SLOWEST = 0.3
"""An error that falls by less in one iteration requires a new matrix."""


class Breather(NamedTuple):
    """A periodic breather at the instant when A and B are real: (component, site 0..M)."""

    constants: Constants
    frequency: float
    data: np.ndarray

    @property
    def quarter(self) -> float:
        """A quarter of the period."""
        return 0.5 * np.pi / self.frequency

    @property
    def finer(self) -> int:
        """How many times more steps a quarter takes where waves are faster than the breather."""
        return max(1, int(np.ceil(highest(self.constants) / self.frequency)))


def exchange_sign(data: np.ndarray) -> int:
    """Return 1 where A = B, -1 where A = -B, and 0 elsewhere."""
    return next((sign for sign in (1, -1) if np.array_equal(data[0], sign * data[1])), 0)


def power(data: np.ndarray) -> np.ndarray:
    """Return the sum of squares over the whole chain of each component, (component,)."""
    return 2.0 * np.sum(data**2, axis=1) - data[:, 0] ** 2


def single_site(constants: Constants, frequency: float, family: str, half_width: int) -> np.ndarray:
    """Return a first guess: the motion of one pair whose neighbours follow it weakly."""
    binding = frequency - constants.omega + 2.0 * constants.epsilon
    if binding <= 0.0:
        raise NoStateError(f"no localised motion of frequency {frequency:g}")
    data = np.zeros((2, half_width + 1))
    data[0, :2] = np.sqrt(2.0 * binding) * np.array([1.0, constants.epsilon / binding])
    if family == "A only":
        data[1] = -constants.gamma / (frequency + constants.omega) * data[0]
    else:
        data[1] = data[0] if family == "A = B" else -data[0]
    return data


def widened(data: np.ndarray, sites: int) -> np.ndarray:
    """Return data with zeros behind their end, or cut off, on so many sites."""
    kept = data[:, :sites]
    return np.pad(kept, ((0, 0), (0, sites - kept.shape[1])))


def shoot(constants: Constants, frequency: float, start: np.ndarray) -> Breather:
    """Return the breather that Newton's method finds from real data, (component, site).

    A start with A = B or A = -B leads to such a breather to the last bit, also where the matrix
    does not determine the step that breaks the symmetry. The matrix costs as much as tens of
    misses, so that it is kept while the error falls, and updated after each step (C. G. Broyden,
    Math. Comp. 19 (1965) 577).
    """
    data, sites, symmetry = start, start.shape[1], exchange_sign(start)
    largest, inverse, step = np.inf, None, None
    for _ in range(ITERATIONS):
        guess = Breather(constants, frequency, data)
        miss = quarter_later(guess, FINE_STEPS)
        last, largest = largest, np.abs(miss[0, ::2]).max() / np.abs(data).max()
        if largest <= TOLERANCE and largest >= 0.1 * last:
            return guess
        if not largest < 10.0:
            break
        miss = miss[0, ::2].ravel()[: sites * (1 if symmetry else 2)]
        if inverse is None or largest > SLOWEST * last:
            inverse = np.linalg.inv(_matrix(guess, symmetry))
        else:  # explain what the last step has left
            wrong, along = times(inverse, miss), times(inverse.T, step)
            inverse -= wrong[:, None] * along / np.sum(step * (step + wrong))
        step = -times(inverse, miss)
        one = step.reshape(-1, sites)
        data = data + (np.concatenate([one, symmetry * one]) if symmetry else one)
    raise NoStateError(f"no breather at the frequency {frequency:g}: {largest:.1e} is left")


def on_half(breather: Breather) -> Breather:
    """Return the breather of the same frequency on a chain of half the half-width."""
    data = widened(breather.data, breather.data.shape[1] // 2 + 1)
    return shoot(breather.constants, breather.frequency, data)


def quarter_later(breather: Breather, steps: int, changes: Sequence = ()) -> np.ndarray:
    """Return where a breather and small changes of its data are after a quarter of a period.

    `changes` are real, (change, component, site); the result is (1 + changes, 4, site), see `flow`.
    """
    nothing = np.empty((0, 4, breather.data.shape[1]))
    evens = real_data(changes) if len(changes) else nothing
    given = evens, nothing, breather.quarter, breather.finer * steps
    return flow(breather.constants, real_data(breather.data), *given)


INSTANTS = ("both real", "both imaginary")
"""The two instants of a period at which P is largest and least, by what A and B are there: P is
even in time about both, and rises or falls all the way between them."""


def power_at(breather: Breather, instant: str) -> np.ndarray:
    """Return P of each component at one of INSTANTS, (component,)."""
    if instant == "both real":
        return power(breather.data)
    return power(quarter_later(breather, FINE_STEPS)[0, 1::2])


CLOSE = 1e-5
"""How far from the least P the frequency may be at which it is looked for. P is flat there, so that
it is known to 1e-9 of itself."""


def least_power(family: list[Breather], instant: str) -> float:
    """Return the least P of a family at an instant.

    It lies between the neighbours of the member with the least P; if this is the first or the last
    member, P falls to the end, and it is this member.
    """
    family = sorted(family, key=lambda one: one.frequency)
    powers = [float(power_at(one, instant).sum()) for one in family]
    middle = int(np.argmin(powers))
    if middle in (0, len(family) - 1):
        return powers[middle]
    start = widened(family[middle].data, family[middle - 1].data.shape[1])

    def total(frequency: float) -> float:
        return float(power_at(shoot(family[0].constants, frequency, start), instant).sum())

    ends = family[middle - 1].frequency, family[middle + 1].frequency
    found = minimize_scalar(total, bounds=ends, method="bounded", options={"xatol": CLOSE})
    return float(found.fun)


def _matrix(guess: Breather, symmetry: int) -> np.ndarray:
    """Return the derivative of the miss by the data; of A alone if A = B or A = -B."""
    sites = guess.data.shape[1]
    one = np.eye(sites)
    both = np.eye(2 * sites).reshape(-1, 2, sites)
    changes = np.stack([one, symmetry * one], axis=1) if symmetry else both
    ends = quarter_later(guess, STEPS, changes)
    return ends[1:, ::2].reshape(len(changes), -1)[:, : len(changes)].T


LARGEST_RATIOS = 2.0, 1.5
"""Of the distances of a frequency and the next one from the waves, and of the two, between which
Newton's method does not lose a family."""
DECAY = 18.0
"""A tail falls by this exponent before the chain ends: to 1.5e-8 of the centre. The end of the
chain changes the centre by the square of that, which is about as much as rounding does."""


def half_width_for(constants: Constants, frequency: float, least: int, most: int) -> int:
    """Return the half-width that the tails need, from their decay beside the nearest band."""
    away = distance_from_bands(constants, frequency) / (2.0 * constants.epsilon)
    if not away:
        return most
    decay = log(1.0 + away + np.sqrt(away * (2.0 + away)))  # the inverse of cosh at 1 + away
    return int(np.clip(np.ceil(DECAY / decay), least, most))


def family_of(constants: Constants, family: str, frequencies, half_widths: Mapping[str, int]):
    """Yield the breathers of a family from the highest frequency down to where it ends.

    Each starts from the one before. "A only" can end above the waves, where it has become A = B.
    """
    wanted = sorted(frequencies, reverse=True)
    edge = constants.omega if family == "A = B" else highest(constants)
    half_width = half_width_for(constants, wanted[0], **half_widths)
    data = single_site(constants, wanted[0], family, half_width)
    for before, frequency in zip([wanted[0], *wanted], wanted, strict=False):
        if frequency <= edge:
            return
        for step in _between(edge, before, frequency):
            half_width = max(half_width, half_width_for(constants, step, **half_widths))
            breather = shoot(constants, step, widened(data, half_width + 1))
            data = breather.data
            if family == "A only" and np.abs(data[0] - data[1]).max() < EQUAL * np.abs(data).max():
                return
        yield breather


EQUAL = 1e-6
"""Where A and B differ by less, relative to the largest, they are equal."""


def _between(edge: float, start: float, end: float) -> list[float]:
    """Return frequencies after `start` down to `end`, so close that each leads to the next.

    `edge` is the frequency below them at which the waves begin.
    """
    ratios = (start - edge) / (end - edge), start / end
    counts = [log(one) / log(most) for one, most in zip(ratios, LARGEST_RATIOS, strict=True)]
    count = max(1, int(np.ceil(max(counts) - 1e-9)))
    away = geometric(start - edge, end - edge, count + 1)[1:-1]
    return [*(float(edge + one) for one in away), end]


def real_data(data: np.ndarray) -> np.ndarray:
    """Return real amplitudes (..., component, M + 1) as states (..., 4, M + 1)."""
    state = np.zeros((*data.shape[:-2], 4, data.shape[-1]))
    state[..., ::2, :] = data
    return state
