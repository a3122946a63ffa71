"""Random numbers: their ranges and moments."""

import numpy as np
from pendula.draws import complex_normal, exponential, uniform


def test_uniform_numbers_fill_their_range():
    drawn = uniform(np.random.default_rng(1), -2.0, 3.0, 10000)
    assert drawn.min() >= -2.0 and drawn.max() < 3.0
    assert abs(drawn.mean() - 0.5) < 0.05 and abs(drawn.std() - 5.0 / np.sqrt(12.0)) < 0.05


def test_complex_numbers_have_normal_parts_that_are_independent():
    drawn = complex_normal(np.random.default_rng(2), (2, 5000))
    assert drawn.shape == (2, 5000)
    parts = np.stack([drawn.real.ravel(), drawn.imag.ravel()])
    np.testing.assert_allclose(np.cov(parts), np.eye(2), atol=0.06)


def test_exponential_numbers_have_mean_and_deviation_one():
    rng = np.random.default_rng(3)
    drawn = np.array([exponential(rng) for _ in range(3000)])
    assert drawn.min() >= 0.0
    assert abs(drawn.mean() - 1.0) < 0.06 and abs(drawn.std() - 1.0) < 0.1
