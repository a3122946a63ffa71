"""Theorems 1 to 3 with explicit constants, for P = |A|^2 + |B|^2 in l2 and gamma >= 0.

With c = |Omega| + 2 gamma + 4 epsilon, every state satisfies |quadratic part of H| <= c P: the
drive contributes -gamma Re sum (A - B)^2, which lies within 2 gamma P.

Theorem 1 (Omega > 2 gamma + 4 epsilon): P <= C = H / (Omega - 2 gamma - 4 epsilon).

Theorem 2 (Omega < -2 gamma, a = |Omega| - 2 gamma): (25) reads -H >= f(P) = a P - P^2 / 4, whose
maximum, the barrier a^2, lies at P = 2 a. P is continuous and H constant, so that data with
P(0) < 2 a and -H < a^2 stay below the smaller root, P <= 2 a (1 - sqrt(1 + H / a^2)). As
-H <= c delta, this covers delta < delta_0 = a^2 / c (below 2 a since a <= c), and
1 - sqrt(1 - x) <= x on [0, 1] gives P <= C_0 delta with C_0 = 2 c / a.

The paper has epsilon > 0. With epsilon < 0 the same holds of (-1)^n A_n, (-1)^n B_n, for which
epsilon is -epsilon and Omega is Omega - 4 epsilon: see `with_positive_coupling`.

Theorem 3 (N sites): H >= P^2 / (8 N) - c P, hence P <= C_N = 4 N (c + sqrt(c^2 + H / (2 N))).
"""

from dataclasses import replace

import numpy as np
from latticode.equations.ends import DIRICHLET, kind_of
from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.numerics.elementary import exp, log

from pendula.problem import Constants


def with_positive_coupling(constants: Constants) -> Constants:
    """Return the constants of the staggered chain where epsilon is negative."""
    if constants.epsilon >= 0:
        return constants
    omega = constants.omega - 4.0 * constants.epsilon
    return replace(constants, epsilon=-constants.epsilon, omega=omega)


def extent(constants: Constants) -> float:
    """Return c = |Omega| + 2 gamma + 4 epsilon, the corrected constant of Theorem 3's proof."""
    k = with_positive_coupling(constants)
    return abs(k.omega) + 2.0 * abs(k.gamma) + 4.0 * k.epsilon


def lipschitz(constants: Constants, radius: float) -> float:
    """Return a Lipschitz constant in l2 of the right-hand side on a ball of this radius.

    The linear part is bounded by |Omega| + 2 gamma + 4 epsilon by (17), and the cubic part by
    3 / 2 times the squared radius, since l2 is an algebra (18).
    """
    return extent(constants) + 1.5 * radius * radius


def theorem_1_bound(energy, constants: Constants):
    """Return C of Theorem 1; infinite outside its range of parameters."""
    k = with_positive_coupling(constants)
    gap = k.omega - 2.0 * abs(k.gamma) - 4.0 * k.epsilon
    return np.asarray(energy) / gap if gap > 0 else np.full(np.shape(energy), np.inf)


def theorem_2_gap(constants: Constants) -> float:
    """Return a = |Omega| - 2 gamma where Omega < -2 gamma, and otherwise 0."""
    k = with_positive_coupling(constants)
    return max(0.0, -k.omega - 2.0 * abs(k.gamma))


def theorem_2_constants(constants: Constants) -> tuple[float, float]:
    """Return (delta_0, C_0) of Theorem 2, (0, inf) outside its range of parameters."""
    a, c = theorem_2_gap(constants), extent(constants)
    return (a * a / c, 2.0 * c / a) if a > 0 else (0.0, np.inf)


def theorem_2_bound(energy, start, constants: Constants):
    """Return the smaller root of f(P) = -H for data with P(0) = `start`; infinite outside."""
    a = theorem_2_gap(constants)
    energy, start = np.broadcast_arrays(np.asarray(energy, float), np.asarray(start, float))
    if a == 0:
        return np.full(energy.shape, np.inf)
    inside = (start < 2.0 * a) & (-energy < a * a)
    root = np.sqrt(np.where(inside, 1.0 + energy / (a * a), 0.0))
    # -H / a^2 = (1 - root)(1 + root): this form keeps the digits of small data
    return np.where(inside, 2.0 * -energy / a / (1.0 + root), np.inf)


def coercivity(power, constants: Constants):
    """Return a lower bound of -H at P = `power` that keeps the bonds (25) drops: Theorem 2 widened.

    On Z, and on a chain with sites at rest beyond its ends, max |A_n|^2 <= |A| |grad A| in l2, so
    that the bonds pay for the quartic term: epsilon g^2 - p^{3/2} g / 4 >= -p^3 / (64 epsilon)
    for each component with p = |A|^2. With p, q = P cos^2 t, P sin^2 t and s = sin 2t,
    -H >= |Omega| P - gamma P (1 + s) - P^3 (1 - 3 s^2 / 4) / (64 epsilon), here at its least s.
    Concave in P. Does not hold on a ring or with free ends, where a constant has no gradient.
    """
    epsilon, gamma, omega = with_positive_coupling(constants)
    with np.errstate(divide="ignore", over="ignore"):
        return _coercivity(np.asarray(power, dtype=float), epsilon, abs(gamma), abs(omega))


def _coercivity(power, epsilon: float, gamma: float, omega: float):
    cubic = power * power / (64.0 * epsilon)
    s = np.minimum(1.0, 2.0 * gamma / (3.0 * cubic))
    return power * (omega - gamma * (1.0 + s) - cubic * (1.0 - 0.75 * s * s))


coercivity_at = inlined_by_llvm(_coercivity)


def widened_barrier(constants: Constants) -> tuple[float, float]:
    """Return (P, -H) at the top of `coercivity`, (0, 0) where Theorem 2 does not apply.

    The slope vanishes at P^2 = 256 epsilon a / 3 as long as s = 1 there, that is 2 a <= gamma,
    and else at P^2 = (32 epsilon / 3) (m + sqrt(m^2 + 4 gamma^2)) with m = |Omega| - gamma.
    With epsilon = gamma = 1, Omega = -4 the top is 13.4 at P = 8.4; (25) has 4 at P = 4.
    """
    epsilon, gamma, omega = with_positive_coupling(constants)
    a = theorem_2_gap(constants)
    if a == 0 or epsilon == 0:
        return 0.0, 0.0
    if 2.0 * a <= abs(gamma):
        top = np.sqrt(256.0 * epsilon * a / 3.0)
    else:
        m = abs(omega) - abs(gamma)
        top = np.sqrt(32.0 * epsilon / 3.0 * (m + np.sqrt(m * m + 4.0 * gamma * gamma)))
    return float(top), float(coercivity(top, constants))


def widened_delta_0(constants: Constants) -> float:
    """Return the radius in P that the widened Theorem 2 covers: -H <= c delta below the barrier."""
    top, barrier = widened_barrier(constants)
    return min(top, barrier / extent(constants))


def widened_bound(energy, start, constants: Constants):
    """Return the smaller root of coercivity(P) = -H by bisection; infinite if not covered."""
    top, barrier = widened_barrier(constants)
    energy, start = np.broadcast_arrays(np.asarray(energy, float), np.asarray(start, float))
    inside = (start < top) & (-energy < barrier)
    epsilon, gamma, omega = with_positive_coupling(constants)
    root = np.empty(energy.shape)
    bisect(-energy.ravel(), top, epsilon, abs(gamma), abs(omega), root.reshape(-1))
    return np.where(inside, root, np.inf)


@kernel
def bisect(depths, top, epsilon, gamma, omega, roots):
    """Write where `coercivity` reaches each of `depths` between 0 and `top`, to the last bit."""
    for i in range(depths.size):
        low, high = 0.0, top
        for _ in range(60):
            middle = 0.5 * (low + high)
            if coercivity_at(max(middle, 1e-300), epsilon, gamma, omega) < depths[i]:
                low = middle
            else:
                high = middle
        roots[i] = high


def theorem_3_bound(energy, sites: int, constants: Constants):
    """Return C_N of Theorem 3."""
    c = extent(constants)
    # a state at the very bottom of H may round below it
    inner = np.maximum(0.0, c * c + np.asarray(energy, float) / (2.0 * sites))
    return 4.0 * sites * (c + np.sqrt(inner))


def proven_region(energy: float, start: float, constants: Constants, boundary: str) -> str:
    """Return which theorem bounds P independently of N, in the words of the ledger."""
    at_rest = kind_of(boundary) == DIRICHLET
    if np.isfinite(theorem_1_bound(energy, constants)):
        return "theorem 1"
    if 0 < start < theorem_2_constants(constants)[0]:
        return "theorem 2"
    if np.isfinite(theorem_2_bound(energy, start, constants)):
        return "theorem 2 by its energy"
    if at_rest and np.isfinite(widened_bound(energy, start, constants)):
        return "theorem 2 widened"
    return "none"


def best_bound(
    energy: float, start: float, sites: int, constants: Constants, boundary: str
) -> float:
    """Return the smallest of the bounds that hold for these data."""
    bounds = [
        theorem_1_bound(energy, constants),
        theorem_2_bound(energy, start, constants),
        theorem_3_bound(energy, sites, constants),
    ]
    if kind_of(boundary) == DIRICHLET:
        bounds.append(widened_bound(energy, start, constants))
    return float(min(bounds))


def growth_margin(tau: np.ndarray, l2: np.ndarray, gamma: float) -> dict[str, float]:
    """Return how close a trajectory with norms `l2`, shape (2, time), comes to the bound (19).

    `from_start`: largest P(tau) / (P(0) e^{4 |gamma| tau}) over tau > 0; `backwards`: the same
    seen from the end; `steepest`: largest |change of log P| over 4 |gamma| times its duration,
    one for any pair of times at the bound. All must be at most one.
    """
    rise = log(np.sum(np.asarray(l2) ** 2, axis=0))
    allowed = 4.0 * abs(gamma) * np.asarray(tau, dtype=float)
    forth = (rise - rise[0]) - (allowed - allowed[0])
    back = (rise - rise[-1]) - (allowed[-1] - allowed)
    steps = np.abs(np.diff(rise))
    bound = np.diff(allowed)
    unbounded = np.where(steps > 0, np.inf, 0.0)  # without a drive P may not move at all
    steepest = np.where(bound > 0, steps / np.where(bound > 0, bound, 1.0), unbounded)
    return {
        "from_start": float(exp(forth[1:].max())),
        "backwards": float(exp(back[:-1].max())),
        "steepest": float(steepest.max()),
    }
