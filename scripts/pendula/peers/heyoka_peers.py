"""heyoka's Taylor method (Biscani and Izzo 2021), on the whole and on half of the chain."""

from functools import partial
from importlib.util import find_spec

import numpy as np

from pendula.simulation.lattice import WHOLE, pack, unpack

from .problem import HALF, Peer, Problem, Solve, check, timed


def why_absent() -> str | None:
    """Return what is missing."""
    return None if find_spec("heyoka") else "the Python package heyoka is not installed"


def equations(problem: Problem, n: int, even: bool, shared: bool):
    """Return [(variable, rate)] of the rows Re A, Im A, Re B, Im B of n sites.

    Where the density is not `shared`, each cubic term is written out as in the manual's examples.
    """
    import heyoka

    epsilon, gamma, omega = map(float, problem.constants)
    names = [f"{row}_{site}" for row in ("x", "y", "u", "v") for site in range(n)]
    rows = np.array(heyoka.make_vars(*names), dtype=object).reshape(4, n)
    density = rows[0::2] ** 2 + rows[1::2] ** 2 if shared else None

    def neighbours(u, j):
        before = [u[j - 1]] if j > 0 else [u[1]] if even else []
        after = [u[j + 1]] if j + 1 < n else []
        return sum(after + before)

    def part(row, j, drive):
        u, im = rows[row], rows[row ^ 1]
        linear = epsilon * (neighbours(u, j) - 2.0 * u[j]) + omega * u[j]
        linear = linear + drive * (rows[(row + 2) % 4][j] - u[j])
        if shared:
            return linear + 0.5 * density[row // 2, j] * u[j]
        return linear + 0.5 * (u[j] * u[j] + im[j] * im[j]) * u[j]

    rates = [
        part(row + 1, j, -gamma) if row % 2 == 0 else -part(row - 1, j, gamma)
        for row in range(4)
        for j in range(n)
    ]
    return list(zip(rows.ravel(), rates, strict=True))


def prepare(problem: Problem, reduction, shared: bool) -> Solve:
    """Return heyoka's integrator, one compiled for each tolerance outside of the measured time.

    Compact mode, because the default one compiles for minutes.
    """
    check(problem, reduction.even)
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


FULL_CHAIN = Peer(
    "heyoka, whole chain", why_absent, partial(prepare, reduction=WHOLE, shared=False)
)
HALF_CHAIN = Peer("heyoka, half chain", why_absent, partial(prepare, reduction=HALF, shared=True))
