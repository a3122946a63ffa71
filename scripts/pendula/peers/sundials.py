"""SUNDIALS CVODE (Hindmarsh et al. 2005) through scikit-sundae: Adams, no dense Jacobian."""

from importlib.util import find_spec

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


def why_absent() -> str | None:
    """Return what is missing."""
    return None if find_spec("sksundae") else "the Python package scikit-sundae is not installed"


def prepare(problem: Problem) -> Solve:
    """Return CVODE's Adams method with GMRES in its implicit steps, on the compiled kernel."""
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


CVODE_ADAMS = Peer("SUNDIALS CVODE, Adams", why_absent, prepare)
