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
    beyond the last, each times `factor`; nothing where sites at rest stand there. Farther beyond a
    free end come the sites before the last one, as in a mirror between two sites.

    Mode k of N sites has the eigenvalue -4 sin^2(half_angle(k, N)) of the lattice Laplacian, and
    mode(k, j, N) are its values on the sites j, orthonormal. `label` is in the titles of figures.
    """

    sees: tuple[int, int] | None
    half_angle: Callable
    mode: Callable
    label: str
    factor: float = 1.0


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


def _half_wave(k, j, sites: int):
    # with a half turn more along the ring
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
"""The kinds of ends that a person can choose, by the name in the configuration."""


def ends_of(boundary: str) -> Ends:
    """Return the ends of that name; raises ValueError where there are none."""
    if boundary not in ENDS:
        raise ValueError(f"there are no ends {boundary!r}; there are {', '.join(ENDS)}")
    return ENDS[boundary]


DIRICHLET, FREE, PERIODIC, MIRROR, ANTIPERIODIC = range(5)
"""What kernels have been taught: beyond an end is a site at rest, none, or the other end; in the
middle of an even chain is its other half; of the last kind, the other end with its sign changed."""


def kind_of(boundary: str) -> int:
    """Return the kind of the ends of that name; raises ValueError where it is none of the above."""
    kinds = {
        (None, 1.0): DIRICHLET,
        ((0, -1), 1.0): FREE,
        ((-1, 0), 1.0): PERIODIC,
        ((-1, 0), -1.0): ANTIPERIODIC,
    }
    ends = ends_of(boundary)
    if (ends.sees, ends.factor) not in kinds:
        seen = f"the sites {ends.sees}" + ("" if ends.factor == 1.0 else f", times {ends.factor:g}")
        raise ValueError(f"the ends {boundary!r} see {seen}, which no equations know yet")
    return kinds[ends.sees, ends.factor]


def neighbours(values: np.ndarray, boundary: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the values to the right and to the left of each site (last axis)."""
    right, left = np.zeros_like(values), np.zeros_like(values)
    right[..., :-1], left[..., 1:] = values[..., 1:], values[..., :-1]
    ends = ends_of(boundary)
    if ends.sees:
        left[..., 0], right[..., -1] = (values[..., place] for place in ends.sees)
    if ends.factor < 0.0:  # numbers may be of any kind, exact ones too
        left[..., 0], right[..., -1] = -left[..., 0], -right[..., -1]
    return right, left
