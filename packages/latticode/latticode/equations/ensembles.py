"""Members of an ensemble: copies of a problem with randomly perturbed initial data."""

import numpy as np

from latticode.numerics.draws import complex_normal
from latticode.numerics.elementary import modulus, product

from .initial_values import InitialValueProblem


def perturb(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (field, 2r + 1) with each amplitude multiplied by 1 + size (x + iy).

    x and y are standard normal. The sites n and -n get the same factor, so even data stay even.
    """
    reach = initial.shape[1] // 2
    drawn = (reach + 1, len(initial))
    factors = 1.0 + size * complex_normal(rng, drawn)
    return product(initial, factors[np.abs(np.arange(-reach, reach + 1))].T)


def perturb_unevenly(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (field, 2r + 3), perturbed independently at each site and one site farther out.

    An amplitude changes by size (x + iy) times its modulus, where x and y are standard normal. A
    zero amplitude, also at the two new sites, changes by size (x + iy) times the largest modulus.
    """
    # ASSUME: an ordinary solver breaks evenness by rounding in its first steps, when only the
    # excited site and its neighbours move and the remaining chain is exactly at rest.
    wider = np.pad(initial, ((0, 0), (1, 1)))
    scale = np.where(wider == 0, modulus(initial).max(), modulus(wider))
    return wider + size * scale * complex_normal(rng, wider.shape)


def perturb_each(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (field, N) on the sites 0..N-1, each value times its own 1 + size (x + iy)."""
    return product(initial, 1.0 + size * complex_normal(rng, initial.shape))


def perturbed(
    problem: InitialValueProblem,
    initial: np.ndarray,
    size: float,
    rng: np.random.Generator,
    kind: str,
) -> np.ndarray:
    """Return perturbed initial data (field, site); `kind` is a key of PERTURBATIONS."""
    # A chain of the sites 0..N-1 has no middle site, so its data cannot be even.
    perturbation = PERTURBATIONS[kind] if problem.site_count is None else perturb_each
    return perturbation(initial, size, rng)


PERTURBATIONS = {"even": perturb, "uneven": perturb_unevenly}
"""The perturbation for each kind of ensemble. The exact solution of even data is even, and so are
all members of an even ensemble. An ordinary solver loses evenness by rounding; members of an uneven
ensemble imitate this."""


def draw_members(
    problem: InitialValueProblem,
    size: float,
    members: int,
    seed: int | list[int],
    kind: str = "even",
) -> list[InitialValueProblem]:
    """Return `members` copies of `problem` with perturbed data; `seed` seeds NumPy's generator."""
    rng = np.random.default_rng(seed)
    drawn = (perturbed(problem, problem.initial, size, rng, kind) for _ in range(members))
    return [problem.changed(initial=initial) for initial in drawn]
