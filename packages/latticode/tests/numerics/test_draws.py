"""Random numbers: their ranges and moments."""

import numpy as np
from latticode.numerics.draws import exponential, normal


def test_exponential_numbers_have_mean_and_deviation_one():
    rng = np.random.default_rng(3)
    drawn = np.array([exponential(rng) for _ in range(3000)])
    assert drawn.min() >= 0.0
    assert abs(drawn.mean() - 1.0) < 0.06 and abs(drawn.std() - 1.0) < 0.1


def test_normal_draws_are_those_of_numpy_but_for_the_last_bits_of_the_tail():
    computed = normal(np.random.default_rng(3), 20_000)
    drawn = np.random.default_rng(3).normal(size=20_000)
    tail = abs(drawn) > 3.65
    assert 0 < tail.sum() < 20 and np.array_equal(computed[~tail], drawn[~tail])
    assert (computed[tail] != drawn[tail]).any() and abs(computed - drawn).max() < 1e-12
    assert (np.ldexp(computed[tail], 40) % 1.0 == 0.0).all()
