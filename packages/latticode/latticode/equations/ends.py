"""Boundary conditions of a chain in one table: neighbours beyond the ends, modes and names.

All code that depends on the boundary reads this table, and raises ValueError for an unknown name.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from latticode.numerics import elementary


class Ends(NamedTuple):
    """One boundary condition at both ends of a chain.

    `sees` has the indices of two sites. The place before the first site has `factor` times the
    value at sees[0]; the place after the last site has `factor` times the value at sees[1]. If
    `sees` is None, both places are at rest. Beyond a free end the chain continues as its mirror
    image, with the mirror half a site beyond the end.

    Mode k of a chain of N sites is an eigenvector of the lattice Laplacian; its eigenvalue is
    -4 sin^2(half_angle(k, N)). mode(k, j, N) returns the values of mode k on the sites j; the modes
    are orthonormal. `label` is printed in the titles of figures.
    """

    sees: tuple[int, int] | None
    half_angle: Callable
    mode: Callable
    label: str
    factor: float = 1.0


def _sine(k: Any, j: np.ndarray, sites: int) -> np.ndarray:
    # reducing angles to one turn in integers loses no digits on long chains
    turns = (k + 1) * (j + 1) % (2 * (sites + 1)) / (2 * (sites + 1))
    return np.sqrt(2 / (sites + 1)) * elementary.sin(2 * np.pi * turns)


def _cosine(k: Any, j: np.ndarray, sites: int) -> np.ndarray:
    turns = k * (2 * j + 1) % (4 * sites) / (4 * sites)
    weights = np.where(k == 0, np.sqrt(1 / sites), np.sqrt(2 / sites))
    return weights * elementary.cos(2 * np.pi * turns)


def _wave(k: Any, j: np.ndarray, sites: int) -> np.ndarray:
    # cos + sin gives real modes; k and N - k are the two modes of one wavelength
    turns = k * j % sites / sites
    sine, cosine = elementary.sine_and_cosine(2 * np.pi * turns)
    return np.sqrt(1 / sites) * (cosine + sine)


def _half_wave(k: Any, j: np.ndarray, sites: int) -> np.ndarray:
    # an odd number of half turns around the ring changes the sign
    turns = (2 * k + 1) * j % (2 * sites) / (2 * sites)
    sine, cosine = elementary.sine_and_cosine(2 * np.pi * turns)
    return np.sqrt(1 / sites) * (cosine + sine)


ENDS = {
    "dirichlet": Ends(
        sees=None,
        half_angle=lambda k, sites: np.pi * (k + 1) / (2 * (sites + 1)),
        mode=_sine,
        label="ends at rest",
    ),
    "free": Ends(
        sees=(0, -1),
        half_angle=lambda k, sites: np.pi * k / (2 * sites),
        mode=_cosine,
        label="free ends",
    ),
    "periodic": Ends(
        sees=(-1, 0),
        half_angle=lambda k, sites: np.pi * k / sites,
        mode=_wave,
        label="ring",
    ),
    "antiperiodic": Ends(
        sees=(-1, 0),
        half_angle=lambda k, sites: np.pi * (2 * k + 1) / (2 * sites),
        mode=_half_wave,
        label="ring with a change of sign",
        factor=-1.0,
    ),
}
"""The boundary conditions that a case can choose, by their names in the configuration."""


def ends_of(boundary: str) -> Ends:
    """Return the boundary condition named `boundary`; raises ValueError for an unknown name."""
    if boundary not in ENDS:
        raise ValueError(f"unknown boundary {boundary!r}; use one of {', '.join(ENDS)}")
    return ENDS[boundary]


DIRICHLET, FREE, PERIODIC, MIRROR, ANTIPERIODIC = range(5)
"""The ends that kernels implement. The neighbour beyond an end is at rest (DIRICHLET), absent
(FREE), or the site at the opposite end (PERIODIC), with the opposite sign if ANTIPERIODIC. MIRROR
is the end at site 0 if only the half 0..M of an even chain is integrated."""


def kind_of(boundary: str) -> int:
    """Return the number of a boundary in kernels; raises ValueError if no kernel implements it."""
    kinds = {
        (None, 1.0): DIRICHLET,
        ((0, -1), 1.0): FREE,
        ((-1, 0), 1.0): PERIODIC,
        ((-1, 0), -1.0): ANTIPERIODIC,
    }
    ends = ends_of(boundary)
    if (ends.sees, ends.factor) not in kinds:
        seen = f"the sites {ends.sees}" + ("" if ends.factor == 1.0 else f", times {ends.factor:g}")
        raise ValueError(f"no kernel implements the ends {boundary!r}, which see {seen}")
    return kinds[ends.sees, ends.factor]


def neighbours(values: np.ndarray, boundary: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the values of the right and the left neighbours of all sites (last axis)."""
    right, left = np.zeros_like(values), np.zeros_like(values)
    right[..., :-1], left[..., 1:] = values[..., 1:], values[..., :-1]
    ends = ends_of(boundary)
    if ends.sees:
        left[..., 0], right[..., -1] = (values[..., place] for place in ends.sees)
    if ends.factor < 0.0:  # unlike a product with -1.0, this keeps integers and other exact types
        left[..., 0], right[..., -1] = -left[..., 0], -right[..., -1]
    return right, left
