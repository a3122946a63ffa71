"""The form (10) of the equations in the variables (9), and the symmetries P and T of (11).

The right-hand side here is written from (10) and shares nothing with the library's chain: where
both agree, the change of variables and the ends are right.
"""

import numpy as np

from pendula.datasets.checks import table, variable

from .hamiltonian import slope
from .runs import BOUNDARIES, random_amplitudes, right_hand_side, run, total_energy


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


def pt_rates(constants, boundary: str, w: np.ndarray) -> np.ndarray:
    """Return (du/dtau, dv/dtau) of (10), shape (2, N)."""
    epsilon, gamma, omega = constants
    u, v = w
    lap_u, lap_v = laplacian(w, boundary)
    uu, vv = np.abs(u) ** 2, np.abs(v) ** 2
    fu = epsilon * lap_v + omega * v + 1j * gamma * u - gamma * u.conj()
    fu = fu + 2.0 * ((2.0 * uu + vv) * v + u**2 * v.conj())
    fv = epsilon * lap_u + omega * u - 1j * gamma * v - gamma * v.conj()
    fv = fv + 2.0 * ((uu + 2.0 * vv) * u + u.conj() * v**2)
    return -1j * np.stack([fu, fv])


def pt_run(constants, boundary: str, w: np.ndarray, end_time: float) -> np.ndarray:
    """Integrate (10) from (u, v) = `w` by SciPy's DOP853, which shares nothing with the library."""
    from scipy.integrate import solve_ivp  # here, so that the other checks do without it

    def function(_, flat):
        return pt_rates(constants, boundary, flat.reshape(w.shape)).ravel()

    solution = solve_ivp(
        function, (0.0, end_time), w.ravel(), "DOP853", rtol=1e-12, atol=1e-14, t_eval=[end_time]
    )
    return solution.y[:, -1].reshape(w.shape)


def parity(w: np.ndarray) -> np.ndarray:
    """Return P (u, v) = (v, u) of (11)."""
    return w[::-1]


def invariance(constants, boundary: str, w: np.ndarray, image) -> float:
    """Return how far (10) is from invariant under w -> image(conj w) with time reversed.

    If W(tau) = image(conj w(-tau)) solves (10), its rate at 0 is -image(conj of the rate of w).
    """
    rate = pt_rates(constants, boundary, w)
    return float(np.abs(pt_rates(constants, boundary, image(w.conj())) + image(rate.conj())).max())


def parity_alone(constants, boundary: str, w: np.ndarray) -> float:
    """Return how far (10) is from invariant under P without T."""
    rate = pt_rates(constants, boundary, w)
    return float(np.abs(pt_rates(constants, boundary, parity(w)) - parity(rate)).max())


def check_pt_form(constants, sites: int, end_time: float, seed: int = 3) -> dict:
    """Compare (10) with (4): rates, trajectories, the energy, and the symmetries (11).

    PT is a symmetry; P alone and T alone are not while gamma is not zero: each misses
    by 2 gamma times the amplitude. The energy of (10) is H / 8: i u' = dH/d(conj v) / 8.
    """
    rng = np.random.default_rng(seed)
    names = ("rates", "trajectory", "pt", "p_alone", "t_alone", "gain", "energy_gradient")
    found = {name: [] for name in names}
    for boundary in BOUNDARIES:
        pair = random_amplitudes(rng, sites, 1.5)
        w = to_pt(pair)
        rates = to_pt(right_hand_side(constants, boundary, pair))
        found["rates"].append(np.abs(pt_rates(constants, boundary, w) - rates).max())
        final = run(constants, boundary, pair, [0.0, end_time]).final
        other = from_pt(pt_run(constants, boundary, w, end_time))
        found["trajectory"].append(np.abs(final - other).max())
        found["pt"].append(invariance(constants, boundary, w, parity))
        found["t_alone"].append(invariance(constants, boundary, w, lambda z: z))
        found["p_alone"].append(parity_alone(constants, boundary, w))
        found["gain"].append(2.0 * abs(constants[1]) * np.abs(w).max())
        found["energy_gradient"].append(pt_energy_error(constants, boundary, w))
    dims = ("boundary",)
    return table(
        "The PT-symmetric form (10) against (4), and the symmetries (11)",
        {"boundary": list(BOUNDARIES)},
        rates=variable(found["rates"], dims, "rates of (10) minus those of (4)", tolerance=1e-13),
        trajectory=variable(found["trajectory"], dims, "(10) minus (4) at the end", tolerance=1e-9),
        pt=variable(found["pt"], dims, "defect of PT", tolerance=1e-13),
        p_alone=variable(found["p_alone"], dims, "defect of P without T"),
        t_alone=variable(found["t_alone"], dims, "defect of T without P"),
        gain=variable(found["gain"], dims, "2 gamma max(|u|, |v|): what P or T alone must miss"),
        energy_gradient=variable(
            found["energy_gradient"], dims, "rates of (10) minus gradient of H / 8", tolerance=1e-12
        ),
    )


def pt_energy_error(constants, boundary: str, w: np.ndarray) -> float:
    """Return the largest |i u' - dK/d(conj v)| or |i v' - dK/d(conj u)| for K = H / 8."""

    def energy(z):
        return total_energy(constants, boundary, from_pt(z)) / 8.0

    gradient = np.zeros_like(w)
    for index in np.ndindex(w.shape):
        unit = np.zeros_like(w)
        unit[index] = 1.0
        by_re, by_im = slope(energy, w, unit), slope(energy, w, 1j * unit)
        gradient[index] = 0.5 * (by_re + 1j * by_im)
    return float(np.abs(1j * pt_rates(constants, boundary, w) - gradient[::-1]).max())
