"""Problems for tests: numbers in the order of the paper, everything else with a default."""

from oracle import SOLVERS
from pendula.problem import Constants, Problem

PAPER = (1.0, 1.0, -4.0)
"""epsilon, gamma and Omega of Fig 3."""


def make_constants(numbers=PAPER):
    """Return (epsilon, gamma, Omega) as constants."""
    epsilon, gamma, omega = map(float, numbers)
    return Constants(epsilon=epsilon, gamma=gamma, omega=omega)


def make_problem(initial, numbers=PAPER, boundary="dirichlet", solver="dop853", **changes):
    """Return the problem of data (2, 2r + 1) up to tau = 1, on the chain that they fill."""
    values = {
        "half_width": initial.shape[1] // 2,
        "end_time": 1.0,
        "output_step": 0.25,
        "solver": SOLVERS[solver] if isinstance(solver, str) else solver,
        **changes,
    }
    return Problem(constants=make_constants(numbers), boundary=boundary, initial=initial, **values)
