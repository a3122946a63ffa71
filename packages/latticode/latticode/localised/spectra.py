"""The Lyapunov spectrum of a motion, from the growth of orthonormalised tangent vectors.

G. Benettin, L. Galgani, A. Giorgilli and J.-M. Strelcyn, Meccanica 15 (1980) 9.
"""

from typing import NamedTuple

import numpy as np

from latticode.measures.growth import mean_rate, mean_rate_error
from latticode.simulation.problem import Problem

from .tangents import STEP, grow, random_tangent

SEED, FEWEST_STEPS = 20170817, 64


class Spectrum(NamedTuple):
    """Lyapunov exponents per unit of tau, in falling order, and the growth of tangent vectors."""

    tau: np.ndarray  # (time,)
    log_growth: np.ndarray  # (number, time), natural logarithm of the growth of a tangent vector
    exponents: np.ndarray  # (number,), over the second half of the run
    errors: np.ndarray  # (number,), standard errors


def count_directions(problem: Problem) -> int:
    """Return the dimension of phase space: the number of real unknowns of a problem."""
    model = problem.model
    rows = 1 if model.form == "dt" else 2
    fixed = len(model.without_imaginary_parts) if model.form == "i_dt" else 0
    return (rows * len(model.fields) - fixed) * problem.sites


def measure_spectrum(problem: Problem, count: int) -> Spectrum:
    """Return the `count` largest Lyapunov exponents of a problem with their standard errors.

    Raises IntegrationError if dop853 cannot finish the run.
    """
    rng, fields = np.random.default_rng(SEED), problem.model.fields
    drawn = [random_tangent(problem.sites, rng, fields=len(fields)) for _ in range(count)]
    tangents = np.array(drawn)
    # imaginary parts that the equations neither read nor change are not degrees of freedom
    fixed = [fields.index(name) for name in problem.model.without_imaginary_parts]
    tangents[:, fixed] = tangents[:, fixed].real
    step = min(STEP, problem.span / FEWEST_STEPS)
    growth = grow(problem, tangents, problem.span, step=step)
    middle = growth.tau[-1] / 2
    exponents = mean_rate(growth.tau, growth.log_growth, middle)
    errors = mean_rate_error(growth.tau, growth.log_growth, middle)
    order = np.argsort(-exponents, kind="stable")
    return Spectrum(growth.tau, growth.log_growth[order], exponents[order], errors[order])
