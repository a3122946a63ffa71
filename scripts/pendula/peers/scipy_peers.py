"""SciPy's integrators, with a right-hand side in NumPy or compiled by this project."""

from functools import partial

import numpy as np
from scipy.integrate import solve_ivp

from pendula.simulation.lattice import WHOLE

from .problem import (
    Peer,
    Problem,
    Solve,
    amplitudes_of,
    chain_of,
    check,
    flat_rates,
    flat_state,
    timed,
)


def why_absent() -> None:
    """SciPy is among this project's requirements."""
    return None


def plain_rates(tau, u, epsilon, gamma, omega):
    """Equations (4) of the complex vector (A, B) as most people would write them in NumPy."""
    n = len(u) // 2
    a, b = u[:n], u[n:]
    left_a, right_a = np.concatenate([[0], a[:-1]]), np.concatenate([a[1:], [0]])
    left_b, right_b = np.concatenate([[0], b[:-1]]), np.concatenate([b[1:], [0]])
    da = epsilon * (right_a - 2 * a + left_a) + omega * a
    da = da + gamma * (np.conj(b) - np.conj(a)) + 0.5 * np.abs(a) ** 2 * a
    db = epsilon * (right_b - 2 * b + left_b) + omega * b
    db = db + gamma * (np.conj(a) - np.conj(b)) + 0.5 * np.abs(b) ** 2 * b
    return -1j * np.concatenate([da, db])


def final(rates, start, end_time, method, absolute, rtol):
    """Return the state at the end, and the seconds; only the two ends are kept."""

    def run():
        return solve_ivp(
            rates,
            (0.0, end_time),
            start,
            method=method,
            t_eval=[end_time],
            rtol=rtol,
            atol=absolute * rtol,
        )

    result, seconds = timed(run)
    if not result.success:
        raise RuntimeError(f"{method} of SciPy gave up: {result.message}")
    return result.y[:, -1], seconds


def prepare_plain(problem: Problem, method: str, absolute: float) -> Solve:
    """Return the solver on complex amplitudes; the absolute tolerance is `absolute` * rtol."""
    check(problem)
    epsilon, gamma, omega = problem.constants
    rates = partial(plain_rates, epsilon=epsilon, gamma=gamma, omega=omega)
    start = problem.amplitudes.astype(complex).ravel()

    def solve(rtol):
        u, seconds = final(rates, start, problem.end_time, method, absolute, rtol)
        return u.reshape(problem.amplitudes.shape), seconds

    return solve


def prepare_compiled(problem: Problem, method: str, absolute: float) -> Solve:
    """Return the solver on the library's real state of the whole chain and its kernel."""
    check(problem)
    chain, start = chain_of(problem, WHOLE), flat_state(problem, WHOLE)

    def rates(tau, u):
        slope = np.empty_like(u)
        flat_rates(chain, np.ascontiguousarray(u), slope)  # Radau gives strided columns
        return slope

    rates(0.0, start)

    def solve(rtol):
        u, seconds = final(rates, start, problem.end_time, method, absolute, rtol)
        return amplitudes_of(u, WHOLE), seconds

    return solve


def peer(method: str, right_hand_side: str) -> Peer:
    """Return a method of `solve_ivp`; RK45 gets the paper's ratio of its two tolerances."""
    absolute = 0.01 if method == "RK45" else 1.0
    prepare = prepare_plain if right_hand_side == "NumPy" else prepare_compiled
    title = f"SciPy {method}, {right_hand_side} right-hand side"
    return Peer(title, why_absent, partial(prepare, method=method, absolute=absolute))


RK45_NUMPY = peer("RK45", "NumPy")
DOP853_NUMPY = peer("DOP853", "NumPy")
RK45 = peer("RK45", "compiled")
DOP853 = peer("DOP853", "compiled")
LSODA = peer("LSODA", "compiled")
RADAU = peer("Radau", "compiled")
