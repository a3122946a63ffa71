"""Steady states of the chain that are localised at one pair: families, spectra, where none is.

A steady state of (4), steady in the rotating frame of (3), obeys

    epsilon (A_{n+1} - 2 A_n + A_{n-1}) + Omega A_n + gamma (conj B_n - conj A_n)
        + |A_n|^2 A_n / 2 = 0                                                                (S)

and the same with A and B exchanged. Here A = a, B = b or A = i a, B = i b with real a and b, as in
the families of one pair (see `models.pairs`), which are continued from epsilon = 0 (R. S. MacKay
and S. Aubry, Nonlinearity 7 (1994) 1623).

Where there is none. Multiply (S) by conj A and its partner by conj B, sum over the chain and take
the real part:

    -epsilon (|dA|^2 + |dB|^2) + Omega P - gamma Re sum (A_n - B_n)^2
        + (1/2) sum (|A_n|^4 + |B_n|^4) = 0,

where |dA|^2 = sum |A_{n+1} - A_n|^2 <= 4 |A|^2 and |A - B|^2 <= 2 (|A|^2 + |B|^2). The left side is
at least (Omega - 4 epsilon - 2 gamma) P plus a sum of fourth powers, which is positive unless all
is zero. So for Omega >= 4 epsilon + 2 gamma no steady state but zero lies in l2, localised or not.

Stability. A perturbation p + i q (times i in the imaginary case) of a state obeys p' = L q,
q' = -K p with the symmetric matrices

    L = epsilon D + Omega + u^2 / 2 + s (1 - X),    K = epsilon D + Omega + 3 u^2 / 2 - s (1 - X),

D the second difference, u^2 the squares of a and b, X the exchange of A and B. So squares of the
exponents are the eigenvalues of -L K, half as many as exponents, and exponents come in pairs of
both signs. On A = B the phase is free: L a = 0 exactly, and one square is zero with a Jordan block.

Numbers. States are even in n, arrays (component, site) on the sites 0..M of a chain whose ends are
at rest. LAPACK solves and finds eigenvalues: what is published is rounded to the digits it has.
"""

from typing import NamedTuple

import numpy as np

from pendula.models.amplitudes import field
from pendula.models.pairs import Family, pair

TOLERANCE = 1e-13
"""Largest residual of (S), relative to the largest of its terms."""
ITERATIONS = 30
LARGEST_CHANGE = 0.1
"""Steps of epsilon that are too large jump between families that live on several sites. So a step
may change a state by a tenth of itself, or else it is halved."""
FIRST_STEP, SMALLEST_STEP = 1 / 8, 1 / 4096
"""Steps of epsilon, relative to that of the chain."""


class Chain(NamedTuple):
    """The constants of the equations and the half-width M."""

    epsilon: float
    gamma: float
    omega: float
    half_width: int


class NotFoundError(ArithmeticError):
    """Newton's method has not converged, or has left the family."""


def second_difference(sites: int, even: bool = True) -> np.ndarray:
    """Return the matrix of u_{n+1} - 2 u_n + u_{n-1} on half a chain at rest beyond its end.

    Even states live on the sites 0..M, odd ones on 1..M, since they vanish at 0.
    """
    matrix = np.diag(np.full(sites, -2.0)) + np.eye(sites, k=1) + np.eye(sites, k=-1)
    if even:
        matrix[0, 1:2] = 2.0
    return matrix


def operators(chain: Chain, s: float, state: np.ndarray, even: bool) -> tuple:
    """Return L and K of the module's text, on even or odd perturbations, each (2 N, 2 N)."""
    kept = state if even else state[:, 1:]
    sites = kept.shape[1]
    linear = chain.epsilon * second_difference(sites, even) + chain.omega * np.eye(sites)
    both = np.zeros((2 * sites, 2 * sites))
    both[:sites, :sites] = both[sites:, sites:] = linear
    exchange = s * (np.eye(2 * sites) - np.eye(2 * sites, k=sites) - np.eye(2 * sites, k=-sites))
    squares = np.diag(kept.ravel() ** 2)
    return both + 0.5 * squares + exchange, both + 1.5 * squares - exchange


def residual(chain: Chain, s: float, state: np.ndarray) -> np.ndarray:
    """Return the left side of (S), an array like `state`, from the equations themselves."""
    right = np.concatenate([state[:, 1:], np.zeros((2, 1))], axis=1)
    sides = {0: state, 1: right, -1: np.concatenate([state[:, 1:2], state[:, :-1]], axis=1)}

    def seen(partner: int, part: int, by: int) -> np.ndarray | float:
        return 0.0 if part else sides[by][:: 1 - 2 * partner]

    return field(chain._replace(gamma=s), seen)[0]


def exchange_sign(data: np.ndarray) -> int:
    """Return 1 where A = B, -1 where A = -B, and 0 elsewhere."""
    return next((sign for sign in (1, -1) if np.array_equal(data[0], sign * data[1])), 0)


def newton(chain: Chain, s: float, start: np.ndarray) -> np.ndarray:
    """Return the steady state that Newton's method finds from `start`, (component, site).

    A start with A = B or A = -B leads to such a state to the last bit, also at a pitchfork, where
    K cannot tell the step that breaks the symmetry from zero.
    """
    state, sign, largest = start, exchange_sign(start), np.inf
    for _ in range(ITERATIONS):
        miss, largest_modulus = residual(chain, s, state), np.abs(state).max()
        cubic = largest_modulus * largest_modulus * largest_modulus / 2.0
        if not 0.0 < cubic < np.inf:
            break
        last, largest = largest, np.abs(miss).max() / cubic
        if largest <= TOLERANCE and largest >= last / 2:  # converged, and rounding is reached
            return state
        slope = operators(chain, s, state, even=True)[1]
        change = np.linalg.solve(slope, miss.ravel()).reshape(state.shape)
        state = state - (0.5 * (change + sign * change[::-1]) if sign else change)
    raise NotFoundError(f"Newton's method finds no state but zero at {chain}")


def continued(chain: Chain, family: Family) -> np.ndarray | None:
    """Return the state of a family at the chain's epsilon, or None where the pair has none.

    Raises NotFoundError where the family does not reach this epsilon.
    """
    ends = pair(family, chain.gamma, chain.omega)
    if ends is None:
        return None
    s = family.drive(chain.gamma)
    state = np.zeros((2, chain.half_width + 1))
    state[:, 0] = ends
    reached, step = 0.0, FIRST_STEP
    while reached < 1.0:
        target = min(1.0, reached + step)
        try:
            found = newton(chain._replace(epsilon=target * chain.epsilon), s, state)
            is_near = np.abs(found - state).max() <= LARGEST_CHANGE * np.abs(state).max()
        except NotFoundError:
            is_near = False
        if is_near:
            state, reached = found, target
            continue
        step /= 2.0
        if step < SMALLEST_STEP:
            raise NotFoundError(f"{family.name} ends at {reached:g} of the coupling of {chain}")
    return state


def squared_exponents(chain: Chain, s: float, state: np.ndarray, even: bool) -> np.ndarray:
    """Return the squares of the exponents of even or odd perturbations, complex, (2 N,).

    Where A = B or A = -B, perturbations with b = a and with b = -a do not mix.
    """
    lower, upper = operators(chain, s, state, even)
    if not np.array_equal(state[0] ** 2, state[1] ** 2):
        return np.linalg.eigvals(-lower @ upper).astype(complex)
    n = len(lower) // 2
    sectors = ([one[:n, :n] + sign * one[:n, n:] for one in (lower, upper)] for sign in (1, -1))
    return np.concatenate([np.linalg.eigvals(-low @ up) for low, up in sectors]).astype(complex)


NOISE = 1e-10
"""Squares of exponents are known to the rounding of matrices whose entries reach about 100, and a
double zero doubles it. A smaller square counts as zero."""


def growth(squares: np.ndarray) -> float:
    """Return the largest rate of growth among exponents with these squares; 0 if none grows."""
    unstable = squares[(np.abs(squares.imag) > NOISE) | (squares.real > NOISE)]
    return float(np.abs(np.sqrt(unstable).real).max(initial=0.0))


def fastest_growth(chain: Chain, family: Family, state: np.ndarray) -> float:
    """Return the rate at which the worst perturbation of a state grows, even or odd."""
    s = family.drive(chain.gamma)
    return max(growth(squared_exponents(chain, s, state, even)) for even in (True, False))


def power(state: np.ndarray) -> np.ndarray:
    """Return the sum of squares over the whole chain of each component, (component,)."""
    return 2.0 * np.sum(state**2, axis=1) - state[:, 0] ** 2
