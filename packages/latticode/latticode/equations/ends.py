"""The ends of a chain, in one table: what lies beyond them, the modes between them, their names.

Whatever depends on the ends of a chain reads this table. So ends that are not in it are refused
wherever they are named, and those that a reader has not been taught cannot pass for others.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from latticode.numerics import elementary


class Ends(NamedTuple):
    """One kind of ends.

    `sees` gives the sites, counted as Python does, whose values stand beyond the first site and
    beyond the last; nothing where sites at rest stand there. Mode k of N sites has the eigenvalue
    -4 sin^2(half_angle(k, N)) of the lattice Laplacian, and mode(k, j, N) are its values on the
    sites j, orthonormal. `label` stands in the titles of figures.
    """

    sees: tuple[int, int] | None
    half_angle: Callable
    mode: Callable
    label: str


def _sine(k, j, sites: int):
    # angles are reduced to one turn in whole numbers, so that long chains lose no digits
    turns = (k + 1) * (j + 1) % (2 * (sites + 1)) / (2 * (sites + 1))
    return np.sqrt(2 / (sites + 1)) * elementary.sin(2 * np.pi * turns)


def _cosine(k, j, sites: int):
    turns = k * (2 * j + 1) % (4 * sites) / (4 * sites)
    weights = np.where(k == 0, np.sqrt(1 / sites), np.sqrt(2 / sites))
    return weights * elementary.cos(2 * np.pi * turns)


def _wave(k, j, sites: int):
    # on a ring, cos + sin serves both waves of a pair
    turns = k * j % sites / sites
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
}
"""The kinds of ends that a person can choose, by the name in the configuration."""


def ends_of(boundary: str) -> Ends:
    """Return the ends of that name; raises ValueError where there are none."""
    if boundary not in ENDS:
        raise ValueError(f"there are no ends {boundary!r}; there are {', '.join(ENDS)}")
    return ENDS[boundary]


DIRICHLET, FREE, PERIODIC = range(3)
"""What equations and proofs have been taught: a site at rest beyond an end, none, the other end."""


def kind_of(boundary: str) -> int:
    """Return the kind of the ends of that name; raises ValueError where it is none of the above."""
    kinds = {None: DIRICHLET, (0, -1): FREE, (-1, 0): PERIODIC}
    sees = ends_of(boundary).sees
    if sees not in kinds:
        raise ValueError(f"the ends {boundary!r} see the sites {sees}, which no equations know yet")
    return kinds[sees]


def neighbours(values: np.ndarray, boundary: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the values to the right and to the left of each site (last axis)."""
    right, left = np.zeros_like(values), np.zeros_like(values)
    right[..., :-1], left[..., 1:] = values[..., 1:], values[..., :-1]
    if sees := ends_of(boundary).sees:
        left[..., 0], right[..., -1] = values[..., sees[0]], values[..., sees[1]]
    return right, left
