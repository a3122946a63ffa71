"""Integrators by other people that are Python packages.

They are SciPy's (with a right-hand side in NumPy or compiled by this project), heyoka's Taylor
method (Biscani and Izzo 2021), CVODE of SUNDIALS (Hindmarsh et al. 2005) through scikit-sundae, and
numbalsoda's DOP853 (Hairer's, in Fortran). SciPy is among this project's requirements; the other
packages are imported when a problem is prepared, so that none of them is needed.
"""

from collections.abc import Callable
from functools import partial
from importlib.util import find_spec

import numba
import numpy as np
from numba import types
from pendula.problem import Problem
from pendula.simulation.lattice import WHOLE, Reduction, pack, unpack
from scipy.integrate import solve_ivp

from .peer import HALF, Peer, Solve, amplitudes_of, chain_of, check, flat_rates, flat_state
from .timing import timed


def needs(module: str, package: str) -> Callable[[], str | None]:
    """Return a function that says what is missing where a module cannot be imported."""

    def why_absent() -> str | None:
        return None if find_spec(module) else f"the Python package {package} is not installed"

    return why_absent


# SciPy


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
    constants = problem.constants
    rates = partial(
        plain_rates, epsilon=constants.epsilon, gamma=constants.gamma, omega=constants.omega
    )
    start = problem.amplitudes

    def solve(rtol):
        u, seconds = final(rates, start.ravel(), problem.end_time, method, absolute, rtol)
        return u.reshape(start.shape), seconds

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


def scipy_peer(method: str, right_hand_side: str) -> Peer:
    """Return a method of `solve_ivp`; RK45 gets the paper's ratio of its two tolerances."""
    absolute = 0.01 if method == "RK45" else 1.0
    prepare = prepare_plain if right_hand_side == "NumPy" else prepare_compiled
    title = f"SciPy {method}, {right_hand_side} right-hand side"
    return Peer(title, lambda: None, partial(prepare, method=method, absolute=absolute))


RK45_NUMPY = scipy_peer("RK45", "NumPy")
DOP853_NUMPY = scipy_peer("DOP853", "NumPy")
RK45 = scipy_peer("RK45", "compiled")
DOP853 = scipy_peer("DOP853", "compiled")
LSODA = scipy_peer("LSODA", "compiled")
RADAU = scipy_peer("Radau", "compiled")


# heyoka


def equations(problem: Problem, n: int, even: bool, shared: bool):
    """Return [(variable, rate)] of the rows Re A, Im A, Re B, Im B of n sites.

    Where |A|^2 and |B|^2 are not `shared`, each cubic term is written out as in the manual's
    examples.
    """
    import heyoka

    epsilon, gamma, omega = (
        float(getattr(problem.constants, name)) for name in ("epsilon", "gamma", "omega")
    )
    names = [f"{row}_{site}" for row in ("x", "y", "u", "v") for site in range(n)]
    rows = np.array(heyoka.make_vars(*names), dtype=object).reshape(4, n)
    squares = rows[0::2] ** 2 + rows[1::2] ** 2 if shared else None

    def neighbours(u, j):
        before = [u[j - 1]] if j > 0 else [u[1]] if even else []
        after = [u[j + 1]] if j + 1 < n else []
        return sum(after + before)

    def part(row, j, drive):
        u, im = rows[row], rows[row ^ 1]
        linear = epsilon * (neighbours(u, j) - 2.0 * u[j]) + omega * u[j]
        linear = linear + drive * (rows[(row + 2) % 4][j] - u[j])
        if shared:
            return linear + 0.5 * squares[row // 2, j] * u[j]
        return linear + 0.5 * (u[j] * u[j] + im[j] * im[j]) * u[j]

    rates = [
        part(row + 1, j, -gamma) if row % 2 == 0 else -part(row - 1, j, gamma)
        for row in range(4)
        for j in range(n)
    ]
    return list(zip(rows.ravel(), rates, strict=True))


def prepare_heyoka(problem: Problem, reduction: Reduction, shared: bool) -> Solve:
    """Return heyoka's integrator, one compiled for each tolerance outside of the measured time.

    It runs in compact mode, because the default one compiles for minutes.
    """
    check(problem, reduction)
    import heyoka

    start = pack(problem.amplitudes, reduction)[:, 1:-1]
    system = equations(problem, start.shape[1], reduction.even, shared)
    compiled = {}

    def solve(rtol):
        if rtol not in compiled:
            compiled[rtol] = heyoka.taylor_adaptive(
                system, start.ravel(), tol=rtol, compact_mode=True
            )
        integrator = compiled[rtol]
        integrator.time = 0.0
        integrator.state[:] = start.ravel()
        outcome, seconds = timed(lambda: integrator.propagate_until(problem.end_time))
        if outcome[0] != heyoka.taylor_outcome.time_limit:
            raise RuntimeError(f"heyoka gave up: {outcome[0]}")
        y = np.zeros((4, start.shape[1] + 2))
        y[:, 1:-1] = integrator.state.reshape(4, -1)
        return unpack(y, reduction), seconds

    return solve


HEYOKA = Peer(
    "heyoka, whole chain",
    needs("heyoka", "heyoka"),
    partial(prepare_heyoka, reduction=WHOLE, shared=False),
)
HEYOKA_HALF = Peer(
    "heyoka, half chain",
    needs("heyoka", "heyoka"),
    partial(prepare_heyoka, reduction=HALF, shared=True),
)


# SUNDIALS


def prepare_cvode(problem: Problem) -> Solve:
    """Return CVODE's Adams method with GMRES in its implicit steps, on the compiled kernel.

    GMRES needs no Jacobian, least of all a dense one.
    """
    check(problem)
    from sksundae.cvode import CVODE

    chain, start = chain_of(problem, WHOLE), flat_state(problem, WHOLE)
    y = start.copy()

    def rates(tau, u, slope):
        y[:] = u  # CVODE's own vector is read-only, and the kernel fills its ghosts
        flat_rates(chain, y, slope)

    rates(0.0, start, start.copy())

    def solve(rtol):
        # a plain limit, because the default of 500 steps is meant for each of many outputs
        solver = CVODE(
            rates, method="Adams", linsolver="gmres", rtol=rtol, atol=rtol, max_num_steps=10**8
        )
        result, seconds = timed(lambda: solver.solve([0.0, problem.end_time], start))
        if not result.success:
            raise RuntimeError(f"CVODE gave up: {result.message}")
        return amplitudes_of(result.y[-1], WHOLE), seconds

    return solve


CVODE_ADAMS = Peer("SUNDIALS CVODE, Adams", needs("sksundae", "scikit-sundae"), prepare_cvode)


# numbalsoda


def c_function(chain, size: int):
    """Return the right-hand side of vectors of `size` numbers as a C function."""
    pointer = types.CPointer(types.float64)

    @numba.cfunc(types.void(types.float64, pointer, pointer, pointer), error_model="numpy")
    def rates(tau, u, slope, nothing):
        flat_rates(chain, numba.carray(u, (size,)), numba.carray(slope, (size,)))

    return rates


def prepare_numbalsoda(problem: Problem, reduction: Reduction) -> Solve:
    """Return DOP853 on the library's real state of the whole or of half the chain."""
    check(problem, reduction)
    from numbalsoda import dop853

    start = flat_state(problem, reduction)
    rates = c_function(chain_of(problem, reduction), start.size)
    times = np.array([0.0, problem.end_time])
    nothing = np.zeros(1)

    def solve(rtol):
        (u, success), seconds = timed(
            lambda: dop853(rates.address, start, times, data=nothing, rtol=rtol, atol=rtol)
        )
        if not success:  # it then returns plausible numbers all the same
            raise RuntimeError("numbalsoda's dop853 gave up")
        return amplitudes_of(u[-1], reduction), seconds

    solve(1e-3)  # compiles the driver
    return solve


NUMBALSODA = Peer(
    "numbalsoda DOP853, whole chain",
    needs("numbalsoda", "numbalsoda"),
    partial(prepare_numbalsoda, reduction=WHOLE),
)
NUMBALSODA_HALF = Peer(
    "numbalsoda DOP853, half chain",
    needs("numbalsoda", "numbalsoda"),
    partial(prepare_numbalsoda, reduction=HALF),
)
