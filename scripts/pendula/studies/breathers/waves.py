"""Frequencies of linear waves, equation (15), and the distance of other frequencies from them."""

import numpy as np

from pendula.problem import Constants


def bands(constants: Constants) -> list[tuple[float, float]]:
    """Return the intervals of positive frequencies of linear waves, of A + B and of A - B.

    Where kappa^2 < 4 gamma^2 a wave of A - B grows and has no frequency: the band starts at 0.
    """
    kappas = np.array([constants.omega - 4.0 * constants.epsilon, constants.omega])
    ends = np.array([0.0 if kappas.prod() < 0.0 else np.abs(kappas).min(), np.abs(kappas).max()])
    low, high = np.sqrt(np.maximum(0.0, ends**2 - 4.0 * constants.gamma**2))
    return [(float(ends[0]), float(ends[1])), (float(low), float(high))]


def highest(constants: Constants) -> float:
    """Return the highest frequency of a linear wave."""
    return max(high for _, high in bands(constants))


def distance_from_bands(constants: Constants, frequency: float) -> float:
    """Return how far the odd multiples of a frequency stay away from the bands; 0 within one."""
    multiples = np.arange(1, 3 + 2 * int(highest(constants) / frequency), 2) * frequency
    away = [np.maximum(low - multiples, multiples - high) for low, high in bands(constants)]
    return float(max(0.0, np.min(away)))
