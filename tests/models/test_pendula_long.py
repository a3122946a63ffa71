"""Four hundred units of t, against power series in the processor's extended precision.

The series are of order 24, in plain NumPy with 64 bits of mantissa, and the drive's phase is their
own: nothing is shared with the library.
"""

import numpy as np
from helpers import skip
from on_pendula import final, pendula

ORDER, STEP = 24, 0.8
Extended = np.longdouble


def accurate(problem) -> np.ndarray:
    """Return angles and velocities (2, 2, N) at the end; the ends of the chain are at rest."""
    constants, mu = problem.constants, Extended(problem.mu)
    square = mu * mu
    coupling, gamma = square * Extended(constants.epsilon), Extended(constants.gamma)
    omega = np.sqrt(1 + square * Extended(constants.omega))
    z, count = problem.amplitudes, int(2 * problem.end_time / problem.mu**2 / STEP) + 1
    x, v = 2 * mu * z.real.astype(Extended), -2 * mu * omega * z.imag.astype(Extended)
    h = 2 * Extended(problem.end_time) / square / count
    powers = h ** np.arange(ORDER + 1, dtype=Extended)
    signs = np.array([1, -1, -1, 1] * (ORDER // 4 + 1), Extended)[: ORDER + 1]
    factors = np.cumprod(np.concatenate([[Extended(1)], 2 * omega / np.arange(1, ORDER + 1)]))
    for step in range(count):
        phase = 2 * omega * (step * h)
        turns = np.array([np.cos(phase), np.sin(phase)] * (ORDER // 2 + 1))[: ORDER + 1]
        drive = 2 * gamma * square * signs * factors * turns
        x, v = sum_of_series(x, v, coupling, drive, powers)
    return np.array([x, v])


def sum_of_series(x, v, coupling, drive, powers):
    """Return the state after one step; `drive` holds the coefficients of D."""
    xs, vs, sines, cosines = (np.zeros((ORDER + 1, *x.shape), Extended) for _ in range(4))
    differences, bonds = np.zeros_like(xs), np.zeros_like(x)
    xs[0], vs[0], sines[0], cosines[0] = x, v, np.sin(x), np.cos(x)
    for k in range(ORDER):
        np.subtract(xs[k, ::-1], xs[k], out=differences[k])
        np.multiply(xs[k], -2, out=bonds)
        bonds[:, 1:] += xs[k, :, :-1]
        bonds[:, :-1] += xs[k, :, 1:]
        driven = np.einsum("k,kci->ci", drive[: k + 1], differences[k::-1])
        xs[k + 1] = vs[k] / (k + 1)
        vs[k + 1] = (coupling * bonds + driven - sines[k]) / (k + 1)
        sines[k + 1] = np.einsum("kci,kci->ci", cosines[: k + 1], vs[k::-1]) / (k + 1)
        cosines[k + 1] = -np.einsum("kci,kci->ci", sines[: k + 1], vs[k::-1]) / (k + 1)
    return (np.einsum("k,kci->ci", powers, series) for series in (xs, vs))


def test_every_method_is_exact_to_twelve_digits_at_the_end():
    if np.finfo(Extended).nmant < 60:
        skip("the processor has no extended precision", "use one of the x86-64 family")
    problem = pendula(half_width=1, end_time=2.0, output_step=1.0)  # t = 400
    exact = accurate(problem).astype(float)
    fine = problem.changed(solver={"name": "kahan_li", "step": 0.05})
    states = {name: final(problem, name) for name in ("taylor", "dop853")}
    states["kahan_li"] = final(fine, None)
    for name, state in states.items():
        assert np.abs(state - exact).max() < 1e-12, name
    assert np.abs(final(problem, "ode45") - exact).max() < 1e-9
