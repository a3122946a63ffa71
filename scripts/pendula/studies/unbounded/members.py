"""Ensembles: the same case from data that differ by less than anybody could measure."""

import numpy as np

SIZE = 1e-6
"""Relative size of the differences: grown to order one within some ten units of tau by chaos."""


def member(initial: np.ndarray, number: int, seed: int = 2017) -> np.ndarray:
    """Return the initial data of an ensemble's member; number 0 has the data as they are.

    All sites of a component share a factor, so that even data stay even.
    """
    if number == 0:
        return initial
    factors = 1.0 + SIZE * np.random.default_rng([seed, number]).normal(size=2)
    return initial * factors[:, None]
