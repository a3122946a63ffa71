"""Integrators by others that are Python packages.

They are SciPy's (with a right-hand side in NumPy or compiled by this project), heyoka's Taylor
method (Biscani and Izzo 2021), CVODE of SUNDIALS (Hindmarsh et al. 2005) through scikit-sundae, and
numbalsoda's DOP853 (Hairer's, in Fortran). SciPy is a requirement of this project. The other
packages are optional, because they are imported only when a problem is prepared. SciPy and heyoka
also integrate Newton's equations.
"""

from dataclasses import asdict, replace
from functools import partial
from time import process_time
from typing import Any

import numba
import numpy as np
from numba import types
from pendula.models.pendula import frequency
from pendula.problem import AMPLITUDES, Constants, PaperProblem
from scipy.integrate import solve_ivp

from .peer import FLAT_RATES, HALF, Peer, Solve, begin, final_of, flat_rates, needs, with_ghosts
from .timing import timed

# SciPy


def plain_rates(
    tau: float, u: np.ndarray, epsilon: float, gamma: float, omega: float
) -> np.ndarray:
    """Return the rates by (4) of the complex vector (A, B), in ordinary NumPy."""
    n = len(u) // 2
    a, b = u[:n], u[n:]
    left_a, right_a = np.concatenate([[0], a[:-1]]), np.concatenate([a[1:], [0]])
    left_b, right_b = np.concatenate([[0], b[:-1]]), np.concatenate([b[1:], [0]])
    da = epsilon * (right_a - 2 * a + left_a) + omega * a
    da = da + gamma * (np.conj(b) - np.conj(a)) + 0.5 * np.abs(a) ** 2 * a
    db = epsilon * (right_b - 2 * b + left_b) + omega * b
    db = db + gamma * (np.conj(a) - np.conj(b)) + 0.5 * np.abs(b) ** 2 * b
    return -1j * np.concatenate([da, db])


def factors_of(problem: PaperProblem) -> dict[str, float]:
    """Return C, 2 gamma mu^2 and 2 omega of equations (1)."""
    constants, square = problem.constants, problem.mu * problem.mu
    return {
        "coupling": constants.epsilon * square,
        "strength": 2 * constants.gamma * square,
        "twice_omega": 2 * frequency(constants.omega, problem.mu),
    }


def prepare_scipy(problem: PaperProblem, method: str, compiled: bool) -> Solve:
    """Return a method of `solve_ivp`; RK45 has the paper's ratio of its two tolerances.

    The right-hand side is in NumPy, or if `compiled` the library's kernel on a state with ghosts.
    """
    system, start, end = begin(problem)
    absolute = 0.01 if method == "RK45" else 1.0
    if compiled:
        kernel = FLAT_RATES[problem.model.name]

        def rates(t: float, u: np.ndarray) -> np.ndarray:
            slope = np.empty_like(u)
            kernel(system, t, np.ascontiguousarray(u), slope)  # Radau gives strided columns
            return slope

        rates(0.0, start.ravel())
    else:
        start = problem.amplitudes
        rates = partial(plain_rates, **asdict(problem.constants))

    def solve(rtol: float) -> tuple[np.ndarray, float]:
        options = {"method": method, "rtol": rtol, "atol": absolute * rtol}
        run, seconds = timed(
            lambda: solve_ivp(rates, (0.0, end), start.ravel(), t_eval=[end], **options)
        )
        if not run.success:
            raise RuntimeError(f"SciPy's {method} failed: {run.message}")
        final = run.y[:, -1]
        return final_of(problem, final) if compiled else final.reshape(start.shape), seconds

    return solve


# heyoka


def neighbours(u: np.ndarray, j: int) -> Any:
    """Return the sum of the neighbours of site j on half of an even chain; u_-1 is u_1."""
    after = [u[j + 1]] if j + 1 < len(u) else []
    return sum([*after, u[j - 1] if j > 0 else u[1]])


def equations(constants: Constants, n: int) -> list:
    """Return [(variable, rate)] of the rows Re A, Im A, Re B, Im B on the n sites of half a chain.

    The rates of Re A and Im A share |A|^2, those of Re B and Im B share |B|^2.
    """
    import heyoka

    epsilon, gamma, omega = constants
    names = [f"{row}_{site}" for row in ("x", "y", "u", "v") for site in range(n)]
    rows = np.array(heyoka.make_vars(*names), dtype=object).reshape(4, n)
    squares = rows[0::2] ** 2 + rows[1::2] ** 2

    def component_rate(row: int, j: int, drive: float) -> Any:
        u = rows[row]
        linear = epsilon * (neighbours(u, j) - 2.0 * u[j]) + omega * u[j]
        linear = linear + drive * (rows[(row + 2) % 4][j] - u[j])
        return linear + 0.5 * squares[row // 2, j] * u[j]

    rates = [
        component_rate(row + 1, j, -gamma) if row % 2 == 0 else -component_rate(row - 1, j, gamma)
        for row in range(4)
        for j in range(n)
    ]
    return list(zip(rows.ravel(), rates, strict=True))


def equations_of_pendula(problem: PaperProblem, n: int) -> list:
    """Return [(variable, rate)] of the rows x, x', y, y', with the drive as a function of t."""
    import heyoka

    factors = factors_of(problem)
    drive = factors["strength"] * heyoka.cos(factors["twice_omega"] * heyoka.time)
    names = [f"{row}_{site}" for row in ("x", "u", "y", "v") for site in range(n)]
    rows = np.array(heyoka.make_vars(*names), dtype=object).reshape(4, n)

    def force(x: np.ndarray, partner: np.ndarray, j: int) -> Any:
        bonds = factors["coupling"] * (neighbours(x, j) - 2.0 * x[j])
        return bonds + drive * (partner[j] - x[j]) - heyoka.sin(x[j])

    pairs = []
    for row in (0, 2):
        pairs += [(rows[row, j], rows[row + 1, j]) for j in range(n)]
        pairs += [(rows[row + 1, j], force(rows[row], rows[2 - row], j)) for j in range(n)]
    return pairs


def prepare_heyoka(problem: PaperProblem) -> Solve:
    """Return heyoka's integrator of half the chain, compiled for each tolerance before it is timed.

    It uses compact mode, because the default mode compiles for minutes.
    """
    _, start, end = begin(problem, HALF)
    import heyoka

    start, compiled = start[:, 1:-1], {}
    sites = start.shape[1]
    system = (
        equations(problem.constants, sites)
        if problem.model.name == AMPLITUDES
        else equations_of_pendula(problem, sites)
    )

    def solve(rtol: float) -> tuple[np.ndarray, float]:
        if rtol not in compiled:
            compiled[rtol] = heyoka.taylor_adaptive(
                system, start.ravel(), tol=rtol, compact_mode=True
            )
        integrator = compiled[rtol]
        integrator.time = 0.0
        integrator.state[:] = start.ravel()
        outcome, seconds = timed(lambda: integrator.propagate_until(end))
        if outcome[0] != heyoka.taylor_outcome.time_limit:
            raise RuntimeError(f"heyoka failed: {outcome[0]}")
        return final_of(problem, with_ghosts(integrator.state), HALF), seconds

    return solve


def survey_by_heyoka(problem: PaperProblem, omega: np.ndarray, amplitude: np.ndarray) -> float:
    """Return the processor time in s of runs over Omega and A_0 of the central pair, in batches.

    A batch has as many runs as a vector of the processor has numbers, and one step size for each.
    No norms are computed. The number of runs is a multiple of the size of a batch.
    """
    import heyoka

    sites, size = problem.sites // 2 + 1, heyoka.recommended_simd_size()
    integrator = heyoka.taylor_adaptive_batch(
        equations(replace(problem.constants, omega=heyoka.par[0]), sites),
        np.zeros((4 * sites, size)),
        tol=problem.solver["rtol"],
        compact_mode=True,
    )
    start = process_time()
    for runs in np.arange(omega.size).reshape(-1, size):
        integrator.state[:] = 0.0
        integrator.state[0], integrator.state[2 * sites] = (
            amplitude[runs],
            problem.initial[1, 0].real,
        )
        integrator.pars[0] = omega[runs]
        integrator.set_time(0.0)
        integrator.propagate_until(np.full(size, problem.end_time))
    return process_time() - start


HEYOKA = Peer("heyoka, half chain", needs("heyoka", "heyoka"), prepare_heyoka)


# SUNDIALS and numbalsoda


def prepare_cvode(problem: PaperProblem) -> Solve:
    """Return CVODE's Adams method on the compiled kernel, with GMRES in its implicit steps.

    GMRES needs no Jacobian matrix.
    """
    chain, start, end = begin(problem)
    from sksundae.cvode import CVODE

    start = start.ravel()
    y = start.copy()

    def rates(tau: float, u: np.ndarray, slope: np.ndarray) -> None:
        y[:] = u  # CVODE's vector is read-only, but the kernel writes ghosts
        flat_rates(chain, tau, y, slope)

    rates(0.0, start, start.copy())

    def solve(rtol: float) -> tuple[np.ndarray, float]:
        # there is one output, and the default limit of steps between outputs is 500
        solver = CVODE(
            rates, method="Adams", linsolver="gmres", rtol=rtol, atol=rtol, max_num_steps=10**8
        )
        result, seconds = timed(lambda: solver.solve([0.0, end], start))
        if not result.success:
            raise RuntimeError(f"CVODE failed: {result.message}")
        return final_of(problem, result.y[-1]), seconds

    return solve


def prepare_numbalsoda(problem: PaperProblem) -> Solve:
    """Return numbalsoda's DOP853 on the library's real state of half the chain."""
    chain, start, end = begin(problem, HALF)
    from numbalsoda import dop853

    start = start.ravel()
    size, pointer = start.size, types.CPointer(types.float64)

    @numba.cfunc(types.void(types.float64, pointer, pointer, pointer), error_model="numpy")
    def rates(tau: float, u: Any, slope: Any, unused: Any) -> None:
        flat_rates(chain, tau, numba.carray(u, (size,)), numba.carray(slope, (size,)))

    times, unused = np.array([0.0, end]), np.zeros(1)

    def solve(rtol: float) -> tuple[np.ndarray, float]:
        (u, success), seconds = timed(
            lambda: dop853(rates.address, start, times, data=unused, rtol=rtol, atol=rtol)
        )
        if not success:  # the returned numbers look plausible even then
            raise RuntimeError("numbalsoda's dop853 failed")
        return final_of(problem, u[-1], HALF), seconds

    solve(1e-3)  # compiles the driver
    return solve


def _scipy(method: str, compiled: bool) -> Peer:
    title = f"SciPy {method}, {'compiled' if compiled else 'NumPy'} right-hand side"
    return Peer(title, lambda: None, partial(prepare_scipy, method=method, compiled=compiled))


PEERS = {
    "scipy_rk45_numpy": _scipy("RK45", compiled=False),
    "scipy_dop853_numpy": _scipy("DOP853", compiled=False),
    "scipy_rk45": _scipy("RK45", compiled=True),
    "scipy_dop853": _scipy("DOP853", compiled=True),
    "scipy_lsoda": _scipy("LSODA", compiled=True),
    "scipy_radau": _scipy("Radau", compiled=True),
    "heyoka_half": HEYOKA,
    "cvode_adams": Peer("SUNDIALS CVODE, Adams", needs("sksundae", "scikit-sundae"), prepare_cvode),
    "numbalsoda_dop853_half": Peer(
        "numbalsoda DOP853, half chain", needs("numbalsoda", "numbalsoda"), prepare_numbalsoda
    ),
}
OF_PENDULA = {"scipy_dop853": PEERS["scipy_dop853"], "heyoka_half": HEYOKA}
"""The peers that integrate Newton's equations."""
