"""The paper's other forms of the equations: reduced (5), and PT-symmetric (10).

The right-hand sides here are written from the paper and share nothing with the library's model:
where both agree, the change of variables (9) and the ends are right.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from pendula.datasets.checks import tabulate
from pendula.ends import neighbours
from pendula.models.linear_chain import curvatures, modes
from pendula.numerics import elementary
from pendula.numerics.elementary import modulus, product, square_modulus
from pendula.numerics.extrapolation import extrapolated
from pendula.numerics.matrices import times
from pendula.problem import Constants

from .equations import (
    BOUNDARIES,
    gradient,
    misstated,
    random_amplitudes,
    right_hand_side,
    run,
    squared_norm,
    total_energy,
)

PT_STEP = 0.05
"""Longest step of the extrapolation for (10)."""


def scalar_runs(epsilon: float, omega: float, boundaries, a: np.ndarray, end_time: float):
    """Integrate the scalar dNLS i a' = epsilon Lap a + Omega a + |a|^2 a / 2, written apart.

    `a` are data (run, N), each with ends of its own. Fourth-order Strang composition (Suzuki): the
    exact linear flow of every mode and the exact rotation of the phase, so that the l2 norm is kept
    but for rounding.
    """
    basis = np.array([modes(a.shape[1], boundary) for boundary in boundaries])
    kappa = epsilon * np.array([curvatures(a.shape[1], one) for one in boundaries]) - omega
    outer = 1.0 / (4.0 - elementary.power(4.0, 1.0 / 3.0))
    count = 100 * max(1, int(np.ceil(end_time)))
    steps = [part * end_time / count for part in (outer, 1.0 - 4.0 * outer)]
    turns = [elementary.turn(kappa * h) for h in steps]

    def turn_phases(a: np.ndarray, h: float) -> np.ndarray:
        return product(a, elementary.turn(-0.5 * h * square_modulus(a)))

    for _ in range(count):
        for i in (0, 0, 1, 0, 0):
            a = turn_phases(a, 0.5 * steps[i])
            a = times(basis.swapaxes(1, 2), product(turns[i], times(basis, a)))
            a = turn_phases(a, 0.5 * steps[i])
    return a


def check_symmetries(
    constants: Constants, sites: int, end_time: float, seed: int, turn: complex = 1.0
) -> dict:
    """Test the exchange of A and B, the reduction A = B (5), its conserved norm, and its equation.

    All four along trajectories: exchange must hold to the last bit, A = B as well. A control asks
    the same of (A, B) -> `turn` (B, A) and of B = `turn` A.
    """
    rng = np.random.default_rng(seed)
    rows, starts, ends = [], [], []
    for boundary in BOUNDARIES:
        pair = random_amplitudes(rng, sites, 2.0)
        forth = run(constants, boundary, pair, end_time, 8).final
        back = run(constants, boundary, product(turn, pair[::-1]), end_time, 8).final
        alike = np.stack([pair[0], product(turn, pair[0])])
        both = run(constants, boundary, alike, end_time, 8)
        norms = squared_norm(both.l2)
        starts.append(pair[0])
        ends.append(both.final[0])
        row = {
            "exchange": modulus(product(turn, forth) - back[::-1]).max(),
            "synchrony": modulus(product(turn, both.final[0]) - both.final[1]).max(),
            "norm_drift": np.abs(norms / norms[0] - 1.0).max(),
        }
        rows.append(row)
    numbers = constants.epsilon, constants.omega
    scalar = scalar_runs(*numbers, BOUNDARIES, np.array(starts), end_time)
    for row, end, other in zip(rows, ends, scalar, strict=True):
        row["scalar"] = modulus(end - other).max()
    about = {
        "exchange": ("change under A <-> B", 0.0),
        "synchrony": ("|A - B| from A = B", 0.0),
        "norm_drift": ("relative drift of l2 on A = B", 1e-10),
        "scalar": ("distance to the scalar dNLS", 1e-7),
    }
    title = "Exchange of A and B, and the invariant reduction A = B (5)"
    return tabulate(title, {"boundary": BOUNDARIES}, rows, about)


def to_pt(amplitudes: np.ndarray) -> np.ndarray:
    """Return (u, v) of (9) from (A, B), both of shape (2, N)."""
    a, b = amplitudes
    return np.stack([a - 1j * b.conj(), a + 1j * b.conj()]) / 4.0


def from_pt(w: np.ndarray) -> np.ndarray:
    """Return (A, B) from (u, v): A = 2 (u + v), conj(B) = 2i (u - v)."""
    u, v = w
    return np.stack([2.0 * (u + v), (2j * (u - v)).conj()])


def pt_rates(constants: Constants, boundary: str, w: np.ndarray) -> np.ndarray:
    """Return (du/dtau, dv/dtau) of (10), shape (2, N)."""
    epsilon, gamma, omega = constants.epsilon, constants.gamma, constants.omega
    u, v = w
    right, left = neighbours(w, boundary)  # along the last axis, with what the ends see beyond them
    lap_u, lap_v = right + left - 2.0 * w
    uu, vv = square_modulus(u), square_modulus(v)
    fu = epsilon * lap_v + omega * v + 1j * gamma * u - gamma * u.conj()
    fu = fu + 2.0 * ((2.0 * uu + vv) * v + product(product(u, u), v.conj()))
    fv = epsilon * lap_u + omega * u - 1j * gamma * v - gamma * v.conj()
    fv = fv + 2.0 * ((uu + 2.0 * vv) * u + product(u.conj(), product(v, v)))
    return -1j * np.stack([fu, fv])


def symmetry_defect(
    constants: Constants, boundary: str, w: np.ndarray, image: Callable, direction: int = 1
) -> float:
    """Return how far (10) is from invariant under w -> image(w) with time in this `direction`.

    If W(tau) = image(w(-tau)) solves (10), its rate at 0 is -image(the rate of w).
    """
    expected = direction * image(pt_rates(constants, boundary, w))
    return float(modulus(pt_rates(constants, boundary, image(w)) - expected).max())


def check_pt_form(
    constants: Constants, sites: int, end_time: float, seed: int, gamma_times: float = 1.0
) -> dict:
    """Compare (10) with (4): rates, trajectories, the energy, and the symmetries (11).

    P exchanges u and v, T takes conjugates and reverses time. PT is a symmetry; P alone and T
    alone are not while gamma is not zero: each misses by 2 gamma times the amplitude. The energy
    of (10) is H / 8: i u' = dH/d(conj v) / 8. Turning all phases is no symmetry either.
    """
    rng, stated = np.random.default_rng(seed), misstated(constants, gamma_times=gamma_times)
    rows, steps, angle = [], int(np.ceil(end_time / PT_STEP)), elementary.turn(0.7)
    for boundary in BOUNDARIES:
        pair = random_amplitudes(rng, sites, 1.5)
        w = later = to_pt(pair)
        for _ in range(steps):  # by extrapolation, which shares nothing with the library
            later = extrapolated(partial(pt_rates, stated, boundary), later, end_time / steps)
        rates, expected = pt_rates(stated, boundary, w), right_hand_side(constants, boundary, pair)
        final = run(constants, boundary, pair, end_time).final
        # K = H / 8, of the constants of the motion, has i u' = dK/d(conj v), i v' = dK/d(conj u)
        slope = gradient(lambda z, b=boundary: total_energy(constants, b, from_pt(z)) / 8.0, w)
        row = {
            "rates": modulus(rates - to_pt(expected)).max(),
            "trajectory": modulus(final - from_pt(later)).max(),
            "pt": symmetry_defect(stated, boundary, w, lambda z: z[::-1].conj(), -1),
            "p_alone": symmetry_defect(stated, boundary, w, lambda z: z[::-1]),
            "t_alone": symmetry_defect(stated, boundary, w, np.conj, -1),
            "gauge_defect": symmetry_defect(stated, boundary, w, lambda z: product(angle, z)),
            "energy_gradient": float(modulus(product(1j, rates) - slope[::-1]).max()),
        }
        rows.append(row)
    about = {
        "rates": ("rates of (10) minus those of (4)", 1e-13),
        "trajectory": ("(10) minus (4) at the end", 1e-9),
        "pt": ("defect of PT", 1e-13),
        "p_alone": "defect of P without T",
        "t_alone": "defect of T without P",
        "gauge_defect": "defect of turning all phases",
        "energy_gradient": ("rates of (10) minus gradient of H / 8", 1e-12),
    }
    title = "The PT-symmetric form (10) against (4), and the symmetries (11)"
    return tabulate(title, {"boundary": BOUNDARIES}, rows, about)
