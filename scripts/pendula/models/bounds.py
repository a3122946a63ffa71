"""Theorems 1 to 3 with explicit constants, for P = |A|^2 + |B|^2 in l2 and gamma >= 0.

With c = |Omega| + 2 gamma + 4 epsilon, every state satisfies |quadratic part of H| <= c P: the
drive contributes -gamma Re sum (A - B)^2, which lies within 2 gamma P.

Theorem 1 (Omega > 2 gamma + 4 epsilon): P <= C = H / (Omega - 2 gamma - 4 epsilon).

Theorem 2 (Omega < -2 gamma, a = |Omega| - 2 gamma): (25) reads -H >= f(P) = a P - P^2 / 4, whose
maximum, the barrier a^2, lies at P = 2 a. P is continuous and H constant, so that data with
P(0) < 2 a and -H < a^2 stay below the smaller root, P <= 2 a (1 - sqrt(1 + H / a^2)). As
-H <= c delta, this covers delta < delta_0 = a^2 / c (below 2 a since a <= c), and
1 - sqrt(1 - x) <= x on [0, 1] gives P <= C_0 delta with C_0 = 2 c / a.

The paper has epsilon > 0. With epsilon < 0 the same holds for (-1)^n A_n and (-1)^n B_n, which obey
(4) with -epsilon and Omega - 4 epsilon: see `with_positive_coupling`.

Theorem 3 (N sites): H >= P^2 / (8 N) - c P, hence P <= C_N = 4 N (c + sqrt(c^2 + H / (2 N))).
"""

from dataclasses import replace

import numpy as np
from latticode.equations.ends import DIRICHLET, kind_of
from latticode.numerics.elementary import exp, log

from .equations import Constants


def with_positive_coupling(constants: Constants) -> Constants:
    """Return the constants, or those of the staggered chain if epsilon is negative."""
    if constants.epsilon >= 0:
        return constants
    omega = constants.omega - 4.0 * constants.epsilon
    return replace(constants, epsilon=-constants.epsilon, omega=omega)


def extent(constants: Constants) -> float:
    """Return c = |Omega| + 2 gamma + 4 epsilon, the constant of Theorem 3's proof, corrected."""
    k = with_positive_coupling(constants)
    return abs(k.omega) + 2.0 * abs(k.gamma) + 4.0 * k.epsilon


def theorem_1_bound(energy: float, constants: Constants) -> float:
    """Return C of Theorem 1, or infinity outside its range of parameters."""
    k = with_positive_coupling(constants)
    gap = k.omega - 2.0 * abs(k.gamma) - 4.0 * k.epsilon
    return float(energy) / gap if gap > 0 else np.inf


def theorem_2_gap(constants: Constants) -> float:
    """Return a = |Omega| - 2 gamma where Omega < -2 gamma, and otherwise 0."""
    k = with_positive_coupling(constants)
    return max(0.0, -k.omega - 2.0 * abs(k.gamma))


def theorem_2_constants(constants: Constants) -> tuple[float, float]:
    """Return (delta_0, C_0) of Theorem 2, or (0, inf) outside its range of parameters."""
    a, c = theorem_2_gap(constants), extent(constants)
    return (a * a / c, 2.0 * c / a) if a > 0 else (0.0, np.inf)


def theorem_2_bound(energy: float, start: float, constants: Constants) -> float:
    """Return the bound of Theorem 2 on P, where `start` is P(0).

    It is the smaller root of f(P) = -H. It is infinite if P(0) or H is beyond the barrier.
    """
    a = theorem_2_gap(constants)
    if not (start < 2.0 * a and -energy < a * a):
        return np.inf
    root = np.sqrt(1.0 + float(energy) / (a * a))
    # -H / a^2 = (1 - root)(1 + root): this form keeps the digits of small data
    return float(2.0 * -energy / a / (1.0 + root))


def widened_barrier(constants: Constants) -> tuple[float, float]:
    """Return (P, -H) at the maximum of a P - P^3 / (64 epsilon), or (0, 0) outside Theorem 2."""
    epsilon, a = with_positive_coupling(constants).epsilon, theorem_2_gap(constants)
    top = float(np.sqrt(64.0 * epsilon * a / 3.0))
    return top, 2.0 * a * top / 3.0


def widened_bound(energy: float, start: float, constants: Constants) -> float:
    """Return a bound on P that covers more initial data than Theorem 2.

    It is the smaller root of a P - P^3 / (64 epsilon) = -H, and infinite beyond the barrier.

    On Z, and on a chain with sites at rest beyond its ends, max |A_n|^2 <= |A| |grad A| in l2. The
    bonds, which (25) drops, then bound the quartic term: for each component with p = |A|^2 and
    g = |grad A|, epsilon g^2 - p^(3/2) g / 4 >= -p^3 / (64 epsilon). This does not hold on a ring
    or with free ends, where a constant has no gradient.
    """
    top, barrier = widened_barrier(constants)
    if not (start < top and -energy < barrier):
        return np.inf
    depth, low, high = -float(energy) / (1.5 * barrier), 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)  # P / top
        if middle - middle * middle * middle / 3.0 < depth:
            low = middle
        else:
            high = middle
    return top * high


def theorem_3_bound(energy: float, sites: int, constants: Constants) -> float:
    """Return C_N of Theorem 3."""
    c = extent(constants)
    # at the minimum of H rounding may make this negative
    inner = max(0.0, c * c + float(energy) / (2.0 * sites))
    return float(4.0 * sites * (c + np.sqrt(inner)))


def find_bounds(
    energy: float, start: float, sites: int, constants: Constants, boundary: str
) -> dict[str, float]:
    """Return each bound on P for this H and P(0) = `start`, or infinity if it does not apply."""
    at_rest = kind_of(boundary) == DIRICHLET
    return {
        "theorem_1": theorem_1_bound(energy, constants),
        "theorem_2": theorem_2_bound(energy, start, constants),
        "widened": widened_bound(energy, start, constants) if at_rest else np.inf,
        "theorem_3": theorem_3_bound(energy, sites, constants),
    }


def proven_region(energy: float, start: float, constants: Constants, boundary: str) -> str:
    """Return the theorem that bounds P independently of N, such as "theorem 1", or "none"."""
    bounds = find_bounds(energy, start, 1, constants, boundary)
    regions = {"theorem_1": "theorem 1", "theorem_2": "theorem 2", "widened": "theorem 2 widened"}
    return next((words for name, words in regions.items() if np.isfinite(bounds[name])), "none")


def growth_margin(tau: np.ndarray, l2: np.ndarray, gamma: float) -> dict[str, float]:
    """Return how close the norms `l2` of a trajectory, (component, time), come to the bound (19).

    `from_start` is the largest P(tau) / (P(0) e^{4 |gamma| tau}) over tau > 0. `steepest` is the
    largest |change of log P| / (4 |gamma| duration). Both must be at most one.
    """
    rise = log(np.sum(np.asarray(l2) ** 2, axis=0))
    allowed = 4.0 * abs(gamma) * np.asarray(tau, dtype=float)
    forth = (rise - rise[0]) - (allowed - allowed[0])
    steps = np.abs(np.diff(rise))
    bound = np.diff(allowed)
    unbounded = np.where(steps > 0, np.inf, 0.0)  # without a drive P is constant
    steepest = np.where(bound > 0, steps / np.where(bound > 0, bound, 1.0), unbounded)
    return {
        "from_start": float(exp(forth[1:].max())),
        "steepest": float(steepest.max()),
    }
