"""Steady states in double precision, to be proved: families of one pair, continued in epsilon.

Nothing here needs to be exact: `existence` proves that a true state is near to the one found, or
rejects it. Yet all is made of + - * / and sqrt in one order, so that the doubles are the same on
every machine. States are even in n, so the sites 0..M are kept, with the sites beyond M at rest.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from pendula.models.pairs import Family, pair

STEPS = 32
"""Of epsilon, from single pairs to the chain."""
ITERATIONS = 30
LARGEST_CHANGE = 0.2
"""A step that changes a state by more, relative to its largest amplitude, has lost the family."""
ROUNDING = 2.0**-50
"""Newton's method has converged where it moves a state by less, relative to its largest."""


class Chain(NamedTuple):
    """The constants of the equations, as doubles, and the half-width M of a chain."""

    epsilon: float
    gamma: float
    omega: float
    half_width: int


class Verdict(IntEnum):
    """Whether a state is proved stable, as datasets keep it."""

    UNDECIDED = -1
    UNSTABLE = 0
    STABLE = 1


class LostError(ArithmeticError):
    """Newton's method has not converged, or has left the family."""


def find_state(chain: Chain, family: Family) -> np.ndarray:
    """Return the state (component, site 0..M) of a family; real numbers, times i if `imaginary`.

    Raises LostError where single pairs have no such state, or where coupling ends the family.
    """
    ends = pair(family, chain.gamma, chain.omega)
    if ends is None:
        raise LostError(f"no pair has a state {family.name} at Omega = {chain.omega:g}")
    state = np.zeros((chain.half_width + 1, 2))
    state[0] = ends
    for step in range(1, STEPS + 1):
        before = state
        state = _newton(chain._replace(epsilon=chain.epsilon * step / STEPS), family, state)
        if not np.abs(state - before).max() <= LARGEST_CHANGE * np.abs(before).max():
            raise LostError(f"{family.name} is lost at {step} of {STEPS} steps to {chain}")
    return state.T.copy()


def _newton(chain: Chain, family: Family, state: np.ndarray) -> np.ndarray:
    """Return the steady state (site, component) that Newton's method reaches."""
    sign = {"equal": 1.0, "opposite": -1.0}.get(family.kind)
    for _ in range(ITERATIONS):
        change = _solve(chain, family.drive(chain.gamma), state)
        moved = state - change
        if sign is not None:  # to the last bit, so that the spectrum splits in two
            moved[:, 1] = sign * moved[:, 0]
        size, far = np.abs(moved).max(), np.abs(moved - state).max()
        state = moved
        if far <= ROUNDING * size:
            return state
    raise LostError(f"Newton's method does not converge for {family.name} at {chain}")


def _solve(chain: Chain, s: float, state: np.ndarray) -> np.ndarray:
    """Return the inverse of K times the residual of a state, by elimination towards the centre.

    K and the residual are those of `existence`, with blocks of two components. Site by site from
    the end, where the linear terms dominate, what is left of the inner sites stays regular.
    """
    coupling = chain.epsilon
    right = np.concatenate([state[1:], np.zeros((1, 2))])
    left = np.concatenate([state[1:2], state[:-1]])
    miss = coupling * ((right + left) - 2.0 * state) + chain.omega * state
    miss += s * (state[:, ::-1] - state) + 0.5 * state * state * state
    diagonal = chain.omega - s - 2.0 * coupling + 1.5 * state * state
    rows = list(zip(diagonal.tolist(), miss.tolist(), strict=True))
    kept = []  # for each site, from the end: the inverse of its block, and its side
    x = y = z = e = f = 0.0  # of the site before: inverse [[x, y], [y, z]], inverse times side
    for n, ((a, d), (g, h)) in reversed(list(enumerate(rows))):
        inner = (2.0 if n == 0 else 1.0) * coupling
        a, b, d = a - inner * coupling * x, s - inner * coupling * y, d - inner * coupling * z
        g, h = g - inner * e, h - inner * f
        scale = a * d - b * b
        x, y, z = d / scale, -b / scale, a / scale
        e, f = x * g + y * h, y * g + z * h
        kept.append((x, y, z, e, f))
    change, p, q = [], 0.0, 0.0
    for x, y, z, e, f in reversed(kept):
        p, q = e - coupling * (x * p + y * q), f - coupling * (y * p + z * q)
        change.append((p, q))
    return np.array(change)
