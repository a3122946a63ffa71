"""The paper's equations once more, plainly and in complex numbers, and data to try them on.

Nothing here uses the library, so that a slip there cannot hide behind the same slip here.
"""

from functools import cache

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

BOUNDARIES = ("dirichlet", "free", "periodic")
SOLVERS = {
    "ode45": {"name": "ode45", "rtol": 1e-7, "atol": 1e-9},
    "ode45_real": {"name": "ode45_real", "rtol": 1e-7, "atol": 1e-9},
    "dop853": {"name": "dop853", "rtol": 1e-12, "atol": 1e-12},
    "taylor": {"name": "taylor", "rtol": 1e-12, "atol": 1e-12},
    **{
        name: {"name": name, "step": 0.005, "tolerance": 1e-14, "iterations": 50}
        for name in ("crank_nicolson", "delfour_fortin_payre")
    },
}
CASES = {  # Omega, (A_0, B_0)
    "fig2_small": (8.0, (1.0, 0.1)),
    "fig2_large": (8.0, (5.0, 1.0)),
    "fig3_small": (-4.0, (1.0, 0.1)),
    "fig3_large": (-4.0, (5.0, 1.0)),
    "fig4_small": (0.0, (1.0, 0.1)),
    "fig4_large": (0.0, (5.0, 1.0)),
}


@cache
def laplacian(sites, boundary):
    """Return the matrix of u_{n+1} - 2 u_n + u_{n-1}, its corners as the ends of the chain say."""
    matrix = np.eye(sites, k=1) - 2.0 * np.eye(sites) + np.eye(sites, k=-1)
    if boundary == "free":  # the neighbour beyond an end equals the end
        matrix[0, 0] += 1.0
        matrix[-1, -1] += 1.0
    if boundary == "periodic":
        matrix[0, -1] += 1.0
        matrix[-1, 0] += 1.0
    matrix.setflags(write=False)
    return matrix


def slope(z, constants, boundary):
    """Return dz/dtau of equation (4) for z of shape (2, N): the rows A and B."""
    epsilon, gamma, omega = constants
    matrix = laplacian(z.shape[1], boundary)
    coupled = epsilon * (z.real @ matrix + 1j * (z.imag @ matrix))  # without a complex matrix
    drive = gamma * (np.conj(z[::-1]) - np.conj(z))
    return -1j * (coupled + omega * z + drive + 0.5 * np.abs(z) ** 2 * z)


def power_series(z, constants, boundary, order):
    """Return the power series (order + 1, 2, N) of the solution of equation (4) from z."""
    epsilon, gamma, omega = constants
    matrix = laplacian(z.shape[1], boundary)
    c, squares = np.zeros((2, order + 1, *z.shape), complex)
    c[0] = z
    for k in range(order):
        squares[k] = (c[: k + 1] * c[k::-1]).sum(axis=0)
        cubic = (squares[: k + 1] * c[k::-1].conj()).sum(axis=0)
        linear = epsilon * c[k] @ matrix.T + omega * c[k]
        drive = gamma * (c[k, ::-1] - c[k]).conj()
        c[k + 1] = -1j * (linear + drive + 0.5 * cubic) / (k + 1)
    return c


def hamiltonian(z, constants, boundary):
    """Return the energy (8), with the bonds that belong to the boundary."""
    epsilon, gamma, omega = constants
    a, b = z
    power = np.abs(a) ** 2 + np.abs(b) ** 2
    on_sites = 0.25 * (np.abs(a) ** 4 + np.abs(b) ** 4) + omega * power
    on_sites += gamma * (a * b + np.conj(a * b)).real
    on_sites -= 0.5 * gamma * (a**2 + np.conj(a) ** 2 + b**2 + np.conj(b) ** 2).real
    if boundary == "dirichlet":
        z = np.pad(z, ((0, 0), (1, 1)))
    if boundary == "periodic":
        z = np.concatenate([z, z[:, :1]], axis=1)
    return on_sites.sum() - epsilon * np.sum(np.abs(np.diff(z, axis=1)) ** 2)


def random_chain(half_width, *, even=False, synchronised=False, seed=0):
    """Return complex amplitudes of order one on all sites of both components."""
    rng = np.random.default_rng([seed, half_width])
    z = rng.normal(size=(2, 2 * half_width + 1)) + 1j * rng.normal(size=(2, 2 * half_width + 1))
    return symmetrise(z, even, synchronised)


def symmetrise(z, even, synchronised):
    """Overwrite the left half by the right one, and B by A, as asked."""
    if even:
        right = z[:, z.shape[1] // 2 :]
        z = np.concatenate([right[:, :0:-1], right], axis=1)
    return np.stack([z[0], z[0]]) if synchronised else z


@st.composite
def chains(draw, widths=(0, 3), even=False, synchronised=False):
    """Draw complex amplitudes on a chain of any half-width in the range."""
    half_width = draw(st.integers(*widths))
    shape = (2, 2, 2 * half_width + 1)
    # thirds, because the sums of simple numbers would not round at all
    drawn = draw(arrays(float, shape, elements=st.floats(-6, 6, width=32))) / 3
    drawn[np.abs(drawn) < 1e-6] = 0.0  # the tolerances are absolute: smaller data are refused
    return symmetrise(drawn[0] + 1j * drawn[1], even, synchronised)


constants = st.tuples(st.floats(0, 2), st.floats(-2, 2), st.floats(-8, 8))
boundaries = st.sampled_from(BOUNDARIES)
