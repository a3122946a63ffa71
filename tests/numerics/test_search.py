"""The search for a highest point, on hills whose tops are known."""

import numpy as np
import pytest
from pendula.numerics.draws import normal
from pendula.numerics.search import maximise_all, settings


def maximise(objective, start, *given):
    """Return best point, best value and best values so far of one search of points (size, n)."""
    *given, seed = given
    found = maximise_all(lambda points: objective(points[0])[None], start[None], *given, [seed])
    return [part[0] for part in found]


def hill(points):
    return -np.sum(10.0 ** np.arange(4) * (points - 1.0) ** 2, axis=1)


def test_it_finds_the_top_of_a_narrow_hill():
    point, value, history = maximise(hill, np.zeros(4), 0.5, 150, 12, 0)
    np.testing.assert_allclose(point, 1.0, atol=1e-4)
    assert np.all(np.diff(history) >= 0) and history[-1] == value


@pytest.mark.parametrize(
    ("n", "size", "mu_eff", "path_c", "rank_one", "length"),
    [
        (4, 12, 3.729458934303067, 0.5, 0.06285462000247571, 1.880952380952381),
        (21, 24, 7.02637555759215, 0.16886357665233717, 0.003965764541729823, 4.52851604754477),
        (3, 200, 52.60152859296629, 0.5118856074761333, 0.02813274717232452, 1.5968775302586076),
    ],
)
def test_its_constants_are_those_of_the_package_of_its_author(
    n, size, mu_eff, path_c, rank_one, length
):
    """By `cma` 4.5.0 without active weights; its step control and rank_mu are other variants."""
    found = settings(n, size)
    assert found.weights.sum() == pytest.approx(1.0) and len(found.weights) == size // 2
    assert found.mu_eff == pytest.approx(mu_eff, rel=1e-14)
    assert found.path_c == pytest.approx(path_c, rel=1e-14)
    assert found.rank_one == pytest.approx(rank_one, rel=1e-14)
    assert found.typical_length == pytest.approx(length, rel=1e-14)


def test_a_single_parent_adds_nothing_to_the_path_and_very_many_replace_the_covariance():
    alone, many = settings(4, 2), settings(3, 200)
    assert alone.mu_eff == 1.0 and alone.rank_mu == 0.0
    assert (alone.path_sigma, alone.damping) == pytest.approx((0.3, 1.3))
    assert many.rank_one + many.rank_mu == 1.0
    assert 1.0 < many.damping - many.path_sigma < 2.0 * np.sqrt(many.mu_eff / 4.0)


def test_a_slope_without_a_top_is_climbed_as_long_as_one_likes():
    """Its steps grow in one direction alone, until rounding would spoil the covariance."""
    _, _, history = maximise(lambda points: points[:, 0], np.zeros(3), 1.0, 400, 8, 0)
    assert np.all(np.isfinite(history)) and history[-1] > 1e6 * history[50] > 0.0


def by_the_tutorial(objective, start, spread, generations, size, seed):
    """Return the best values, and which steps were so long that the path of C had to wait.

    These are the equations of section A of the tutorial, with draws through a Cholesky factor.
    """
    n, rng, s = len(start), np.random.default_rng(seed), settings(len(start), size)
    mean, sigma, c, drift, path = np.array(start), spread, np.eye(n), np.zeros(n), np.zeros(n)
    best, waits = [], []
    for generation in range(1, generations + 1):
        z = normal(rng, (size, n))
        y = z @ np.linalg.cholesky(c).T
        values = objective(mean + sigma * y)
        best.append(max([*best[-1:], values.max()]))
        chosen = np.argsort(-values)[: size // 2]
        z, y, w = z[chosen], y[chosen], s.weights
        mean = mean + sigma * (w @ y)
        drift = (1 - s.path_sigma) * drift
        drift += np.sqrt(s.path_sigma * (2 - s.path_sigma) * s.mu_eff) * (w @ z)
        length = np.linalg.norm(drift)
        fade = np.sqrt(1 - (1 - s.path_sigma) ** (2 * generation))
        h = length / fade < (1.4 + 2 / (n + 1)) * s.typical_length
        waits.append(not h)
        path = (1 - s.path_c) * path
        path += h * np.sqrt(s.path_c * (2 - s.path_c) * s.mu_eff) * (w @ y)
        c = (1 - s.rank_one - s.rank_mu + s.rank_one * (1 - h) * s.path_c * (2 - s.path_c)) * c
        c += s.rank_one * np.outer(path, path) + s.rank_mu * (y.T * w) @ y
        sigma *= np.exp(s.path_sigma / s.damping * (length / s.typical_length - 1))
    return np.array(best), waits


@pytest.mark.parametrize("objective", [hill, lambda points: points[:, 0]], ids=["hill", "slope"])
def test_its_steps_are_those_of_the_tutorial(objective):
    given = np.zeros(4), 0.5, 25, 12, 3
    expected, waits = by_the_tutorial(objective, *given)
    np.testing.assert_allclose(maximise(objective, *given)[2], expected, rtol=1e-9)
    if objective is not hill:
        assert any(waits) and not all(waits)
