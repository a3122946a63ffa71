"""Small systems in the calling convention of the integrators, which know nothing of chains.

The oscillator of van der Pol, x'' = mu (1 - x^2) x' - x, is one complex component z = x + i x';
large mu has sudden turns, and negative mu blows up. The Riccati equation x' = p x + q x^2 has
solutions in closed form, and so have the implicit schemes for q = 0.
"""

import numpy as np
from latticode.integrators import crank_nicolson, dop853, ode45, taylor
from latticode.integrators.taylor import BLOCK_SIZE, ORDER
from latticode.kernels.compiled import kernel, uncached
from latticode.kernels.simd import LANES
from scipy.integrate import solve_ivp

START = 2.0 + 0.5j


@uncached
def oscillate(mu, y, dy):
    dy[0, 1] = y[1, 1]
    dy[1, 1] = mu * (1.0 - y[0, 1] * y[0, 1]) * y[1, 1] - y[0, 1]


@uncached
def continue_oscillation(mu, series):
    """Write the coefficients of x and y of all orders; the third part of each is that of x^2."""
    c = series.memory[:BLOCK_SIZE].reshape(ORDER + 1, 3, LANES)
    for k in range(ORDER):
        square = cubic = 0.0
        for j in range(k + 1):
            square += c[j, 0, 0] * c[k - j, 0, 0]
        c[k, 2, 0] = square
        for j in range(k + 1):
            cubic += c[j, 2, 0] * c[k - j, 1, 0]
        c[k + 1, 0, 0] = c[k, 1, 0] / (k + 1)
        c[k + 1, 1, 0] = (mu * (c[k, 1, 0] - cubic) - c[k, 0, 0]) / (k + 1)


@uncached
def riccati(factors, y, dy):
    for row in range(2):
        dy[row, 1] = factors[0] * y[row, 1] + factors[1] * y[row, 1] * y[row, 1]


@uncached
def mean_riccati(factors, old, new, middle, dy):
    for row in range(2):
        middle[row, 1] = 0.5 * (old[row, 1] + new[row, 1])
    riccati(factors, middle, dy)


@uncached
def keep(system, y, i, record):
    record[0, i] = y[0, 1]
    record[1, i] = y[1, 1]


solve_ode45 = ode45.build(oscillate, keep)
solve_dop853 = dop853.build(oscillate, keep)
solve_taylor = taylor.build(continue_oscillation, keep)
solve_crank_nicolson = crank_nicolson.build(riccati, keep)
solve_delfour_fortin_payre = crank_nicolson.build_conserving(mean_riccati, keep)


@kernel
def run_ode45(system, y, times, controls, work, record, stop):
    return solve_ode45(system, y, times, controls, work, record, stop)


@kernel
def run_dop853(system, y, times, controls, work, record, stop):
    return solve_dop853(system, y, times, controls, work, record, stop)


@kernel
def run_taylor(system, y, times, controls, work, record, stop):
    return solve_taylor(system, y, times, controls, work, record, stop)


@kernel
def run_crank_nicolson(system, y, times, controls, work, record, stop):
    return solve_crank_nicolson(system, y, times, controls, work, record, stop)


@kernel
def run_delfour_fortin_payre(system, y, times, controls, work, record, stop):
    return solve_delfour_fortin_payre(system, y, times, controls, work, record, stop)


METHODS = {
    "ode45": (run_ode45, ode45.WORK),
    "dop853": (run_dop853, dop853.WORK),
    "taylor": (run_taylor, taylor.WORK),
    "crank_nicolson": (run_crank_nicolson, crank_nicolson.WORK),
    "delfour_fortin_payre": (run_delfour_fortin_payre, crank_nicolson.WORK),
}


def run(name, system, times, controls, start=START, record=None, stop=None):
    """Return z at the output times (NaN where none was reached), the final z, and the outcome.

    `record` is where z is written, `stop` the flag that ends the run.
    """
    method, work = METHODS[name]
    y = np.zeros((2, 3))
    y[:, 1] = start.real, start.imag
    record = np.full((2, len(times)), np.nan) if record is None else record
    stop = np.zeros(1, np.bool_) if stop is None else stop
    controls, work = tuple(map(float, controls)), np.zeros((work, 2, 3))
    outcome = method(system, y, np.asarray(times, float), controls, work, record, stop)
    return record[0] + 1j * record[1], complex(y[0, 1], y[1, 1]), outcome


def oscillator(mu):
    """Return dz/dt of the oscillator as a function of z, in plain NumPy."""
    return lambda z: z.imag + 1j * (mu * (1 - z.real**2) * z.imag - z.real)


def accurate(mu, times, start=START):
    """Return z of the oscillator at the output times, by SciPy with tight tolerances."""

    def slope(_, z):
        return oscillator(mu)(z)

    span = times[0], times[-1]
    tight = {"method": "DOP853", "rtol": 3e-14, "atol": 1e-14}
    return solve_ivp(slope, span, [start], t_eval=times, **tight).y[0]


def stopped_by(output, outputs):
    """Return a record, and a flag that is raised when a positive number is written as `output`.

    The flag is the highest byte of that number.
    """
    record = np.zeros((2, outputs))
    return record, record[0, output : output + 1].view(np.bool_)[7:8]
