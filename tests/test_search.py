"""The search for a highest point, on hills whose tops are known."""

import numpy as np
from pendula.search import maximise


def hill(points):
    return -np.sum(10.0 ** np.arange(4) * (points - 1.0) ** 2, axis=1)


def test_it_finds_the_top_of_a_narrow_hill():
    point, value, history = maximise(hill, np.zeros(4), 0.5, 150, 12, 0)
    np.testing.assert_allclose(point, 1.0, atol=1e-4)
    assert np.all(np.diff(history) >= 0) and history[-1] == value


def test_it_finds_the_top_of_a_ridge_that_lies_across_the_axes():
    """Steps alone along the axes would take thousands of generations: the covariance must turn."""

    def ridge(points):
        along, across = points[:, 0] + points[:, 1], points[:, 0] - points[:, 1]
        return -((along - 2.0) ** 2) - 1e6 * across**2

    point, _, _ = maximise(ridge, np.array([3.0, -2.0]), 0.5, 150, 12, 1)
    np.testing.assert_allclose(point, 1.0, atol=1e-3)


def test_a_flat_function_does_not_stop_it():
    _, value, history = maximise(lambda points: np.zeros(len(points)), np.zeros(3), 1.0, 60, 8, 2)
    assert value == 0.0 and np.all(history == 0.0)


def test_another_seed_takes_another_path():
    first, second = (maximise(hill, np.zeros(4), 0.5, 5, 12, seed)[1] for seed in (3, 4))
    assert first != second
