"""Members of an ensemble: copies of a problem whose data differ by a random relative change."""

import numpy as np

from latticode.numerics.draws import complex_normal
from latticode.numerics.elementary import modulus, product

from .initial_values import InitialValueProblem


def perturb(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (field, 2r + 1), each amplitude times 1 + size (x + iy) of Gaussian x and y.

    Sites n and -n take the same factors, so that even data stay even.
    """
    reach = initial.shape[1] // 2
    drawn = (reach + 1, len(initial))
    factors = 1.0 + size * complex_normal(rng, drawn)
    return product(initial, factors[np.abs(np.arange(-reach, reach + 1))].T)


def perturb_unevenly(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (field, 2r + 3): each one times 1 + size (x + iy), and neighbours not at rest.

    Sites n and -n are perturbed independently. What is at rest, out to the sites beside the data,
    gets size (x + iy) times the largest amplitude.
    """
    # ASSUME: what breaks evenness in an ordinary solver is the rounding of its first steps, when
    # the excited site and its neighbours move and the rest of the chain is exactly at rest.
    wider = np.pad(initial, ((0, 0), (1, 1)))
    scale = np.where(wider == 0, modulus(initial).max(), modulus(wider))
    return wider + size * scale * complex_normal(rng, wider.shape)


def perturb_each(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (field, N) on the sites 0..N-1, each times 1 + size (x + iy) of its own."""
    return product(initial, 1.0 + size * complex_normal(rng, initial.shape))


def perturbed(
    problem: InitialValueProblem,
    initial: np.ndarray,
    size: float,
    rng: np.random.Generator,
    kind: str,
) -> np.ndarray:
    """Return data of a problem as a member of an ensemble has them."""
    # a chain of the sites 0..N-1 has no middle to be even about
    perturbation = PERTURBATIONS[kind] if problem.site_count is None else perturb_each
    return perturbation(initial, size, rng)


PERTURBATIONS = {"even": perturb, "uneven": perturb_unevenly}
"""The kinds of ensembles. The solution of even data is even, and its ensemble is that of even runs;
an ordinary solver loses evenness by rounding, and what it draws is one of the uneven runs."""


def draw_members(
    problem: InitialValueProblem,
    size: float,
    members: int,
    seed: int | list[int],
    kind: str = "even",
) -> list[InitialValueProblem]:
    """Return as many copies of `problem` with perturbed data; `seed` is that of NumPy."""
    rng = np.random.default_rng(seed)
    drawn = (perturbed(problem, problem.initial, size, rng, kind) for _ in range(members))
    return [problem.changed(initial=initial) for initial in drawn]
