"""A search for the maximum of a costly function: the evolution strategy CMA-ES.

N. Hansen, The CMA Evolution Strategy: A Tutorial, arXiv 1604.00772, with its default constants.
The objective receives whole generations, so that their runs share the processor's cores.
"""

from typing import NamedTuple

import numpy as np


class Settings(NamedTuple):
    """The strategy's constants, all functions of the dimension and the size of a generation."""

    weights: np.ndarray
    mu_eff: float
    path_sigma: float
    damping: float
    path_c: float
    rank_one: float
    rank_mu: float
    typical_length: float


def settings(n: int, size: int) -> Settings:
    """Return the default constants for n dimensions and generations of `size`."""
    weights = np.log(0.5 * (size + 1)) - np.log(np.arange(1, size // 2 + 1))
    weights /= weights.sum()
    mu = 1.0 / np.sum(weights**2)
    path_sigma = (mu + 2.0) / (n + mu + 5.0)
    damping = 1.0 + 2.0 * max(0.0, np.sqrt((mu - 1.0) / (n + 1.0)) - 1.0) + path_sigma
    path_c = (4.0 + mu / n) / (n + 4.0 + 2.0 * mu / n)
    rank_one = 2.0 / ((n + 1.3) ** 2 + mu)
    rank_mu = min(1.0 - rank_one, 2.0 * (mu - 2.0 + 1.0 / mu) / ((n + 2.0) ** 2 + mu))
    length = np.sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n))
    return Settings(weights, mu, path_sigma, damping, path_c, rank_one, rank_mu, length)


def maximise(objective, start: np.ndarray, spread: float, generations: int, size: int, seed: int):
    """Return (best point, best value, best value after each generation).

    `objective` maps points (size, n) to values (size,). Starts from `start` with steps of
    `spread` in every direction.
    """
    rng = np.random.default_rng(seed)
    n, mean, sigma = len(start), np.array(start, float), spread
    s = settings(n, size)
    covariance, drift, path = np.eye(n), np.zeros(n), np.zeros(n)
    best_point, best, history = mean, -np.inf, []
    for generation in range(generations):
        scales, axes = np.linalg.eigh(covariance)
        scales = np.sqrt(np.maximum(scales, 1e-30))
        steps = (rng.normal(size=(size, n)) * scales) @ axes.T
        values = objective(mean + sigma * steps)
        order = np.argsort(-values)
        if values[order[0]] > best:
            best, best_point = float(values[order[0]]), mean + sigma * steps[order[0]]
        history.append(best)
        kept = steps[order[: len(s.weights)]]
        move = s.weights @ kept
        mean = mean + sigma * move
        white = axes @ ((axes.T @ move) / scales)
        drift = (1 - s.path_sigma) * drift + np.sqrt(
            s.path_sigma * (2 - s.path_sigma) * s.mu_eff
        ) * white
        length = np.linalg.norm(drift)
        fade = np.sqrt(1 - (1 - s.path_sigma) ** (2 * generation + 2))
        steady = float(length / fade < (1.4 + 2 / (n + 1)) * s.typical_length)
        path = (1 - s.path_c) * path + steady * np.sqrt(s.path_c * (2 - s.path_c) * s.mu_eff) * move
        missed = (1 - steady) * s.path_c * (2 - s.path_c)
        covariance = (1 - s.rank_one - s.rank_mu + s.rank_one * missed) * covariance
        covariance += s.rank_one * np.outer(path, path) + s.rank_mu * (kept.T * s.weights) @ kept
        sigma *= np.exp(s.path_sigma / s.damping * (length / s.typical_length - 1))
    return best_point, best, np.array(history)
