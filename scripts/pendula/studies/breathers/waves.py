"""Frequencies of linear waves, equation (15), and how far from them a motion swings.

They stand apart from `periodic`, since a picture shows them and must not be drawn anew where an
integrator changes.
"""

import numpy as np

from pendula.problem import Constants


def bands(constants: Constants) -> list[tuple[float, float]]:
    """Return the intervals of positive frequencies of linear waves, of A + B and of A - B.

    Where kappa^2 < 4 gamma^2 a wave of A - B grows and has no frequency: the band starts at 0.
    """
    ends = np.abs([constants.omega - 4.0 * constants.epsilon, constants.omega])
    least = 0.0 if constants.omega * (constants.omega - 4.0 * constants.epsilon) < 0 else ends.min()
    squares = np.array([least, ends.max()]) ** 2 - 4.0 * constants.gamma**2
    low, high = np.sqrt(np.maximum(0.0, squares))
    return [(float(least), float(ends.max())), (float(low), float(high))]


def distance_from_bands(constants: Constants, frequency: float) -> float:
    """Return how far the odd multiples of a frequency stay away from the bands; 0 within one."""
    highest = max(end for _, end in bands(constants))
    multiples = np.arange(1, 3 + 2 * int(highest / frequency), 2) * frequency
    away = [np.maximum(low - multiples, multiples - high) for low, high in bands(constants)]
    return float(max(0.0, np.min(away)))
