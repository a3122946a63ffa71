"""Where families of steady states are born, turn and change their stability, as Omega changes.

A family is followed along its own arc (pseudo-arclength continuation, H. B. Keller, in P. H.
Rabinowitz (ed.), Applications of Bifurcation Theory (Academic Press, 1977), 359): the unknowns are
the state and Omega, and the added equation keeps the step along the tangent. So a turning point in
Omega is nothing special. An asymmetric family turns where it is born: beyond the pitchfork the
same curve goes back with a and b exchanged. The pitchfork itself is found to all digits as the
root of an eigenvalue on the symmetric family: that of exchange-odd perturbations, for which
K of `steady` is epsilon D + Omega - 2 s + 3 u^2 / 2 from a = b, and of exchange-even ones, for
which it is epsilon D + Omega + 3 u^2 / 2, from a = -b.
"""

import numpy as np
from scipy.optimize import brentq

from pendula.models.pairs import Family

from .steady import (
    ITERATIONS,
    Chain,
    NotFoundError,
    continued,
    fastest_growth,
    operators,
    residual,
    second_difference,
)

ARC = 0.05
"""Length of a step along a branch, in the largest norm of state and Omega."""
ARC_STEPS = 400


def follow(chain: Chain, family: Family, state: np.ndarray, stop: float) -> list:
    """Return the points (Omega, state) of a family from `state` on to larger Omega and back.

    The last one is the first whose Omega is below `stop`.
    """
    points, s = [(chain.omega, state)], family.drive(chain.gamma)
    slope = operators(chain, s, state, even=True)[1]
    tangent = np.append(-np.linalg.solve(slope, state.ravel()), 1.0)
    for _ in range(ARC_STEPS):
        tangent /= np.abs(tangent).max()
        omega, state = _step(chain, s, *points[-1], tangent)
        points.append((omega, state))
        if omega < stop:
            return points
        last = points[-2]
        tangent = np.append((state - last[1]).ravel(), omega - last[0])
    raise NotFoundError(f"the branch does not end within {ARC_STEPS} steps from {chain}")


def _step(chain: Chain, s: float, omega: float, state: np.ndarray, tangent: np.ndarray) -> tuple:
    """Return the point of the branch one step along the tangent, by Newton's method."""
    start = np.append(state.ravel(), omega)
    point = start + ARC * tangent
    for _ in range(ITERATIONS):
        here = chain._replace(omega=float(point[-1]))
        at = point[:-1].reshape(state.shape)
        miss = np.append(
            residual(here, s, at).ravel(), np.sum(tangent * (point - start - ARC * tangent))
        )
        slope = np.block([
            [operators(here, s, at, even=True)[1], at.reshape(-1, 1)],
            [tangent[None, :-1], tangent[None, -1:]],
        ])  # fmt: skip
        change = np.linalg.solve(slope, miss)
        point = point - change
        if np.abs(change).max() <= 1e-12 * np.abs(point).max():
            return float(point[-1]), point[:-1].reshape(state.shape)
    raise NotFoundError(f"the branch is lost at {chain}")


def turning_point(points: list) -> float:
    """Return the largest Omega on a branch, by the parabola through the three highest points."""
    omegas = np.array([omega for omega, _ in points])
    top = int(np.clip(omegas.argmax(), 1, len(omegas) - 2))
    before, at, after = omegas[top - 1 : top + 2]
    return float(at + (after - before) ** 2 / (8.0 * (2.0 * at - before - after)))


def pitchfork(chain: Chain, parent: Family, low: float, high: float) -> float:
    """Return the Omega between `low` and `high` where an asymmetric family leaves its parent.

    The largest eigenvalue of K on perturbations that break the parent's symmetry vanishes there.
    """
    shift = -2.0 * parent.drive(chain.gamma) if parent.kind == "equal" else 0.0

    def eigenvalue(omega: float) -> float:
        state = continued(chain._replace(omega=omega), parent)
        linear = chain.epsilon * second_difference(state.shape[1])
        matrix = linear + np.diag(omega + shift + 1.5 * state[0] ** 2)
        return float(np.linalg.eigvals(matrix).real.max())

    return brentq(eigenvalue, low, high, xtol=1e-13)


def threshold(chain: Chain, family: Family, low: float, high: float, digits: float) -> float:
    """Return the Omega between `low` and `high` below which a family is stable, by bisection.

    Two Omega that are no further apart than `digits` enclose it. Raises NotFoundError if the family
    is not stable at `low`, or is at `high`.
    """

    def is_stable(omega: float) -> bool:
        here = chain._replace(omega=omega)
        return not fastest_growth(here, family, continued(here, family))

    if not is_stable(low):
        raise NotFoundError(f"{family.name} is not stable at {low:g}")
    if is_stable(high):
        raise NotFoundError(f"{family.name} is stable at {high:g}")
    while high - low > digits:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_stable(middle) else (low, middle)
    return 0.5 * (low + high)
