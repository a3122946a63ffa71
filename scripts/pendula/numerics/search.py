"""A search for the highest point of a function that has several hills and no known slope.

It is the evolution strategy CMA-ES (N. Hansen, The CMA Evolution Strategy: A Tutorial,
arXiv 1604.00772, with its default constants), with the Cholesky factor of the covariance in place
of its root, as in O. Krause, D. R. Arbones and C. Igel, Advances in Neural Information Processing
Systems 29 (2016): a root needs eigenvectors, whose signs depend on the processor. It stands here
although the package `cma` has it, which takes eigenvectors, seeds NumPy's global generator, and
would be one more pin, of 25,000 lines, in place of 70 that one reads beside the tutorial.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .draws import normal
from .elementary import exp, log
from .matrices import cholesky, multiply, times

LEAST_SCALE = 1e-14
"""Least variance of a step over the largest: rounding cannot make the covariance indefinite."""


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
    """Return the tutorial's default constants for n dimensions and generations of `size`."""
    weights = log(0.5 * (size + 1)) - log(np.arange(1, size // 2 + 1))
    weights /= weights.sum()
    mu = 1.0 / np.sum(weights**2)
    path_sigma = (mu + 2.0) / (n + mu + 5.0)
    damping = 1.0 + 2.0 * max(0.0, np.sqrt((mu - 1.0) / (n + 1.0)) - 1.0) + path_sigma
    path_c = (4.0 + mu / n) / (n + 4.0 + 2.0 * mu / n)
    rank_one = 2.0 / ((n + 1.3) * (n + 1.3) + mu)
    rank_mu = min(1.0 - rank_one, 2.0 * (mu - 2.0 + 1.0 / mu) / ((n + 2.0) * (n + 2.0) + mu))
    length = np.sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n))
    return Settings(weights, mu, path_sigma, damping, path_c, rank_one, rank_mu, length)


def maximise_all(
    objective, starts: np.ndarray, spread: float, generations: int, size: int, seeds: Sequence
):
    """Return the best points, the best values, and these after each generation, of each search.

    Searches run side by side, each with the bits that it has alone. They begin from `starts`
    (search, n) with steps of `spread` in every direction; `objective` maps points (search, size, n)
    to values (search, size). They share every call, which for a few numbers costs more than
    computing them.
    """
    rngs = [np.random.default_rng(seed) for seed in seeds]
    mean, (count, n) = np.array(starts, float), np.shape(starts)
    s, one = settings(n, size), np.eye(n)
    sigma, covariance = np.full(count, float(spread)), np.broadcast_to(one, (count, n, n))
    drift, path, forgotten = np.zeros((count, n)), np.zeros((count, n)), 1.0
    best_points, best, history = mean, np.full(count, -np.inf), []
    for _ in range(generations):
        drawn = np.stack([normal(rng, (size, n)) for rng in rngs])
        least = LEAST_SCALE * covariance.diagonal(0, 1, 2).max(axis=1)
        factor = cholesky(covariance + least[:, None, None] * one)
        steps = times(factor[:, None], drawn)
        points = mean[:, None] + sigma[:, None, None] * steps
        values = objective(points)
        order = np.argsort(-values, axis=1, kind="stable")[:, :, None]
        top = np.take_along_axis(values, order[:, 0], axis=1)[:, 0]
        points = np.take_along_axis(points, order[:, :1], axis=1)[:, 0]
        best_points = np.where((top > best)[:, None], points, best_points)
        best = np.where(top > best, top, best)
        history.append(best)
        parents, weights = order[:, : len(s.weights)], s.weights[:, None]
        kept = np.take_along_axis(steps, parents, axis=1)
        move = np.sum(weights * kept, axis=1)
        mean = mean + sigma[:, None] * move
        white = np.sum(weights * np.take_along_axis(drawn, parents, axis=1), axis=1)
        drift = (1 - s.path_sigma) * drift + np.sqrt(
            s.path_sigma * (2 - s.path_sigma) * s.mu_eff
        ) * white
        length = np.sqrt(np.sum(drift * drift, axis=1))
        forgotten *= (1 - s.path_sigma) * (1 - s.path_sigma)
        steady = length / np.sqrt(1 - forgotten) < (1.4 + 2 / (n + 1)) * s.typical_length
        taken = steady * np.sqrt(s.path_c * (2 - s.path_c) * s.mu_eff)
        path = (1 - s.path_c) * path + taken[:, None] * move
        missed = ~steady * s.path_c * (2 - s.path_c)
        fading = 1 - s.rank_one - s.rank_mu + s.rank_one * missed
        covariance = fading[:, None, None] * covariance
        covariance += s.rank_one * path[:, :, None] * path[:, None, :]
        covariance += s.rank_mu * multiply(kept.swapaxes(1, 2), weights * kept)
        sigma = sigma * exp(s.path_sigma / s.damping * (length / s.typical_length - 1))
    return best_points, best, np.array(history).T
