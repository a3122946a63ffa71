"""The paper's other forms of the equations: reduced (5), and PT-symmetric (10).

The right-hand sides here are written from the paper and share nothing with the library's model:
where both agree, the change of variables (9) and the ends are right.
"""

from collections.abc import Callable
from dataclasses import astuple

import numpy as np

from pendula.datasets.checks import tabulate
from pendula.models.linear_chain import curvatures, modes
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


def scalar_run(epsilon: float, omega: float, boundary: str, a: np.ndarray, end_time: float):
    """Integrate the scalar dNLS i a' = epsilon Lap a + Omega a + |a|^2 a / 2, written apart.

    Fourth-order Strang composition (Suzuki): the exact linear flow of every mode and the exact
    rotation of the phase, so that the l2 norm is kept but for rounding.
    """
    basis = modes(len(a), boundary)
    kappa = epsilon * curvatures(len(a), boundary) - omega
    outer = 1.0 / (4.0 - 4.0 ** (1.0 / 3.0))
    count = 100 * max(1, int(np.ceil(end_time)))
    for _ in range(count):
        for part in (outer, outer, 1.0 - 4.0 * outer, outer, outer):
            h = part * end_time / count
            a = a * np.exp(-0.25j * h * np.abs(a) ** 2)
            a = basis.T @ (np.exp(1j * kappa * h) * (basis @ a))
            a = a * np.exp(-0.25j * h * np.abs(a) ** 2)
    return a


def check_symmetries(
    constants: Constants, sites: int, end_time: float, seed: int, turn: complex = 1.0
) -> dict:
    """Test the exchange of A and B, the reduction A = B (5), its conserved norm, and its equation.

    All four along trajectories: exchange must hold to the last bit, A = B as well. A control asks
    the same of (A, B) -> `turn` (B, A) and of B = `turn` A.
    """
    rng = np.random.default_rng(seed)
    rows = []
    for boundary in BOUNDARIES:
        pair = random_amplitudes(rng, sites, 2.0)
        forth = run(constants, boundary, pair, end_time, 8).final
        back = run(constants, boundary, turn * pair[::-1], end_time, 8).final
        alike = np.stack([pair[0], turn * pair[0]])
        both = run(constants, boundary, alike, end_time, 8)
        norms = squared_norm(both.l2)
        scalar = scalar_run(constants.epsilon, constants.omega, boundary, pair[0], end_time)
        rows.append(
            {
                "exchange": np.abs(turn * forth - back[::-1]).max(),
                "synchrony": np.abs(turn * both.final[0] - both.final[1]).max(),
                "norm_drift": np.abs(norms / norms[0] - 1.0).max(),
                "scalar": np.abs(both.final[0] - scalar).max(),
            }
        )
    about = {
        "exchange": ("change under A <-> B", 0.0),
        "synchrony": ("|A - B| from A = B", 0.0),
        "norm_drift": ("relative drift of l2 on A = B", 1e-10),
        "scalar": ("distance to the scalar dNLS", 1e-7),
    }
    title = "Exchange of A and B, and the invariant reduction A = B (5)"
    return tabulate(title, {"boundary": BOUNDARIES}, rows, about)


def laplacian(w: np.ndarray, boundary: str) -> np.ndarray:
    """Return w_{n+1} - 2 w_n + w_{n-1} along the last axis, with what the ends see beyond them."""
    right, left = np.roll(w, -1, axis=-1), np.roll(w, 1, axis=-1)
    if boundary == "dirichlet":
        right[..., -1] = left[..., 0] = 0.0
    elif boundary == "free":
        right[..., -1], left[..., 0] = w[..., -1], w[..., 0]
    return right + left - 2.0 * w


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
    epsilon, gamma, omega = astuple(constants)
    u, v = w
    lap_u, lap_v = laplacian(w, boundary)
    uu, vv = np.abs(u) ** 2, np.abs(v) ** 2
    fu = epsilon * lap_v + omega * v + 1j * gamma * u - gamma * u.conj()
    fu = fu + 2.0 * ((2.0 * uu + vv) * v + u**2 * v.conj())
    fv = epsilon * lap_u + omega * u - 1j * gamma * v - gamma * v.conj()
    fv = fv + 2.0 * ((uu + 2.0 * vv) * u + u.conj() * v**2)
    return -1j * np.stack([fu, fv])


def pt_run(constants: Constants, boundary: str, w: np.ndarray, end_time: float) -> np.ndarray:
    """Integrate (10) from (u, v) = `w` by SciPy's DOP853, which shares nothing with the library."""
    from scipy.integrate import solve_ivp  # here, so that the other checks do without it

    def function(_, flat):
        return pt_rates(constants, boundary, flat.reshape(w.shape)).ravel()

    solution = solve_ivp(
        function, (0.0, end_time), w.ravel(), "DOP853", rtol=1e-12, atol=1e-14, t_eval=[end_time]
    )
    return solution.y[:, -1].reshape(w.shape)


def symmetry_defect(
    constants: Constants, boundary: str, w: np.ndarray, image: Callable, direction: int = 1
) -> float:
    """Return how far (10) is from invariant under w -> image(w) with time in this `direction`.

    If W(tau) = image(w(-tau)) solves (10), its rate at 0 is -image(the rate of w).
    """
    expected = direction * image(pt_rates(constants, boundary, w))
    return float(np.abs(pt_rates(constants, boundary, image(w)) - expected).max())


def check_pt_form(
    constants: Constants, sites: int, end_time: float, seed: int, gamma_times: float = 1.0
) -> dict:
    """Compare (10) with (4): rates, trajectories, the energy, and the symmetries (11).

    P exchanges u and v, T takes conjugates and reverses time. PT is a symmetry; P alone and T
    alone are not while gamma is not zero: each misses by 2 gamma times the amplitude. The energy
    of (10) is H / 8: i u' = dH/d(conj v) / 8.
    """
    rng, stated = np.random.default_rng(seed), misstated(constants, gamma_times=gamma_times)
    rows = []
    for boundary in BOUNDARIES:
        pair = random_amplitudes(rng, sites, 1.5)
        w = to_pt(pair)
        rates = to_pt(right_hand_side(constants, boundary, pair))
        final = run(constants, boundary, pair, end_time).final
        other = from_pt(pt_run(stated, boundary, w, end_time))
        rows.append(
            {
                "rates": np.abs(pt_rates(stated, boundary, w) - rates).max(),
                "trajectory": np.abs(final - other).max(),
                "pt": symmetry_defect(stated, boundary, w, lambda z: z[::-1].conj(), -1),
                "p_alone": symmetry_defect(stated, boundary, w, lambda z: z[::-1]),
                "t_alone": symmetry_defect(stated, boundary, w, np.conj, -1),
                "energy_gradient": pt_energy_error(constants, stated, boundary, w),
            }
        )
    about = {
        "rates": ("rates of (10) minus those of (4)", 1e-13),
        "trajectory": ("(10) minus (4) at the end", 1e-9),
        "pt": ("defect of PT", 1e-13),
        "p_alone": ("defect of P without T", None),
        "t_alone": ("defect of T without P", None),
        "energy_gradient": ("rates of (10) minus gradient of H / 8", 1e-12),
    }
    title = "The PT-symmetric form (10) against (4), and the symmetries (11)"
    return tabulate(title, {"boundary": BOUNDARIES}, rows, about)


def pt_energy_error(constants: Constants, stated: Constants, boundary: str, w: np.ndarray) -> float:
    """Return the largest |i u' - dK/d(conj v)| or |i v' - dK/d(conj u)| for K = H / 8.

    The rates are those of (10) with the `stated` constants, which are the same but in a control.
    """
    expected = gradient(lambda z: total_energy(constants, boundary, from_pt(z)) / 8.0, w)[::-1]
    return float(np.abs(1j * pt_rates(stated, boundary, w) - expected).max())
