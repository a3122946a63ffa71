"""Frequencies of linear waves, equation (15), and the distance of other frequencies from them."""

import numpy as np

from pendula.numerics.elementary import cos
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


def free_intervals(constants: Constants) -> list[tuple[float, float]]:
    """Return the intervals of frequencies none of whose odd multiples meets a band, rising.

    Only there a periodic breather can exist on an infinite chain. The last one has no upper end.
    """
    taken = []
    for low, high in bands(constants):
        # from this multiple on the bands, divided by it and by the next odd one, overlap
        last = int(2.0 * low / (high - low)) + 2
        taken += [(low / m, high / m) for m in range(1, last, 2)]
        taken.append((0.0, high / last))
    free, reached = [], 0.0
    for low, high in sorted(taken):
        if low > reached:
            free.append((reached, low))
        reached = max(reached, high)
    return [*free, (reached, np.inf)]


def band_traces(constants: Constants, frequency: float) -> list[tuple[float, float]]:
    """Return the intervals of nu = -cos(pi omega / lambda) that the bands of `bands` fill.

    A wave exp(-i omega tau) has the multiplier -exp(-i pi omega / lambda) over half a period of a
    breather, with the change of sign there.
    """
    found = []
    for low, high in bands(constants):
        inside = np.arange(np.ceil(low / frequency), np.floor(high / frequency) + 1.0) * frequency
        traces = -cos(np.pi / frequency * np.concatenate([[low, high], inside]))
        found.append((float(traces.min()), float(traces.max())))
    return found
