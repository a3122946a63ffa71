"""Newton's equations (1) integrated beside the amplitude equations (4): which time is slow?

The expansion (3) is written with A_n(mu^2 t), the equations (4) hold for tau = mu^2 t / 2. Against
the pendula themselves only the second leaves an error of order mu^3.
"""

import numpy as np

from pendula.datasets.checks import table, variable

from .pt_symmetry import laplacian
from .runs import right_hand_side, run


def pendula_rates(t: float, flat: np.ndarray, drives, frequency: float, bonds) -> np.ndarray:
    """Return the rates of angles and velocities of (1), flat from (2, run, pendulum x or y, site).

    `drives` holds the amplitude of D(t) for each run, `bonds` the matrix C Lap.
    """
    angles, velocities = flat.reshape(2, len(drives), 2, -1)
    drive = np.cos(2.0 * frequency * t) * drives[:, None, None]
    forces = angles @ bonds + drive * (angles[:, ::-1] - angles) - np.sin(angles)
    return np.concatenate([velocities.ravel(), forces.ravel()])


def pendula_run(constants, mu: float, boundary: str, amplitudes: np.ndarray, times) -> np.ndarray:
    """Return the angles (time, run, 2, N) of (1) from the data that (3) makes of `amplitudes`.

    Run 0 has the drive as it is, run 1 with the opposite sign. The velocity keeps the slow rate
    of the amplitudes, so that the data err by mu^3 only.
    """
    from scipy.integrate import solve_ivp  # here, so that the other checks do without it

    epsilon, gamma, omega = constants
    frequency = np.sqrt(1.0 + mu * mu * omega)
    slow = 0.5 * mu * mu * right_hand_side(constants, boundary, amplitudes)
    angles = 2.0 * mu * amplitudes.real
    velocities = 2.0 * mu * (1j * frequency * amplitudes + slow).real
    bonds = epsilon * mu * mu * laplacian(np.eye(amplitudes.shape[1]), boundary)
    drives = 2.0 * gamma * mu * mu * np.array([1.0, -1.0])
    solution = solve_ivp(
        pendula_rates,
        (0.0, times[-1]),
        np.stack([[angles, angles], [velocities, velocities]]).ravel(),
        "DOP853",
        t_eval=times,
        rtol=1e-7,
        atol=1e-7 * mu,
        args=(drives, frequency, bonds),
    )
    return solution.y.T.reshape(len(times), 2, 2, *amplitudes.shape)[:, 0]


def envelope_run(constants, boundary: str, amplitudes: np.ndarray, taus) -> np.ndarray:
    """Return the amplitudes (time, 2, N) of (4) at the slow times `taus`, the first of them 0."""
    states = [amplitudes]
    for step in np.diff(taus):
        states.append(run(constants, boundary, states[-1], [0.0, step]).final)
    return np.array(states)


def expansion_errors(constants, mu: float, boundary: str, amplitudes, end: float) -> list[float]:
    """Return max |x - x of (3)| up to mu^2 t / 2 = `end` for three readings of the equations.

    The slow time mu^2 t / 2, the slow time mu^2 t, and the first with pendula that feel the drive
    with the opposite sign, which is the same as shifting it by half a period.
    """
    times = np.linspace(0.0, 2.0 * end / mu**2, 41)
    phase = np.exp(1j * np.sqrt(1.0 + mu * mu * constants[2]) * times)[:, None, None]
    angles, shifted = pendula_run(constants, mu, boundary, amplitudes, times).swapaxes(0, 1)
    half = envelope_run(constants, boundary, amplitudes, 0.5 * mu**2 * times)
    whole = envelope_run(constants, boundary, amplitudes, mu**2 * times)
    pairs = ((angles, half), (angles, whole), (shifted, half))
    return [float(np.abs(x - 2.0 * mu * (z * phase).real).max()) for x, z in pairs]


def order_in_mu(mus, errors) -> float:
    """Return the power of mu that fits the errors at its two smallest values."""
    return float(np.log(errors[-2] / errors[-1]) / np.log(mus[-2] / mus[-1]))


def check_expansion(
    constants, sites: int, end: float, mus=(0.2, 0.1, 0.05), pair=(1.0, 0.1)
) -> dict:
    """Measure the order in mu of the expansion's error for each reading: only one has order 3."""
    amplitudes = np.zeros((2, sites), complex)
    amplitudes[:, sites // 2] = pair
    errors = np.array([expansion_errors(constants, mu, "dirichlet", amplitudes, end) for mu in mus])
    orders = [order_in_mu(mus, column) for column in errors.T]
    dims, readings = ("reading",), ["mu^2 t / 2", "mu^2 t", "mu^2 t / 2, opposite drive"]
    return table(
        "Newton's equations (1) against the expansion (3) with the amplitudes of (4)",
        {"mu": np.asarray(mus), "reading": readings},
        error=variable(errors, ("mu", "reading"), "largest error of an angle", "rad"),
        order=variable(orders, dims, "order in mu of the error"),
        order_error=variable(
            abs(orders[0] - 3.0), (), "distance to 3 of the order with mu^2 t / 2", tolerance=0.5
        ),
    )
