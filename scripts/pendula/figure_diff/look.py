"""Whether two pictures look alike, where text may be drawn a little otherwise.

Pictures are averaged over 4 by 4 pixels (75 dots an inch: what an eye sees of a page) and blurred,
which takes away hinting. Then, around each point, the ink and the colours that the two do not share
are divided by all that there is of them (the Bray-Curtis distance: 0 same, 1 nothing in common), at
the best of all shifts by up to two points (8 pixels). A lost label or a swapped colour differs at
any shift, and by all of its own ink, however small it is beside the whole.
"""

import itertools
from collections.abc import Iterator

import numpy as np
from scipy.ndimage import gaussian_filter, uniform_filter

from .pictures import inks

REDUCED, BLUR, SHIFT = 4, 1.0, 2
WINDOW = 9
"""About the height of a letter and of its surroundings, 36 pixels."""
FAINT = np.array([0.02, 0.03])
"""Darkness and colour that count as nothing: a speck is not a label."""


def unlikeness(reference: np.ndarray, new: np.ndarray, shift: int = SHIFT) -> np.ndarray:
    """Return the map of the distance, one value for each square of 4 by 4 pixels."""
    was, now = (_blurred(pixels, shift) for pixels in (reference, new))
    present = [_around(abs(channels)) for channels in (was, now)]
    best = np.full(was.shape[1:], np.inf, np.float32)
    for moved, there in _shifted((now, present[1]), shift):
        apart = _around(abs(was - moved)) / (present[0] + there + FAINT[:, None, None])
        np.minimum(best, apart.max(0), out=best)
    return best[shift:-shift, shift:-shift]


def _blurred(pixels: np.ndarray, margin: int) -> np.ndarray:
    channels = np.pad(inks(pixels, REDUCED), [(0, 0), (margin, margin), (margin, margin)])
    return gaussian_filter(channels, (0, BLUR, BLUR))


def _around(channels: np.ndarray) -> np.ndarray:
    """Return the means of darkness, and of both contrasts together, over a window."""
    both = np.stack([channels[0], channels[1] + channels[2]])
    return uniform_filter(both, (0, WINDOW, WINDOW), mode="constant")


def _shifted(arrays: tuple, shift: int) -> Iterator[list[np.ndarray]]:
    steps = range(-shift, shift + 1)
    for step in itertools.product(steps, steps):
        yield [np.roll(array, step, (1, 2)) for array in arrays]
