"""The sine and the cosine that kernels take, of numbers and of vectors."""

import numpy as np
import pytest
from latticode.generation.toolbox import sine_and_cosine
from latticode.kernels.compiled import kernel
from latticode.kernels.simd import LANES, load, store


@kernel
def turn_numbers(x, s, c):
    for i in range(x.size):
        s[i], c[i] = sine_and_cosine(x[i])


@kernel
def turn_vectors(x, s, c):
    for i in range(0, x.size, LANES):
        sine, cosine = sine_and_cosine(load(x, i))
        store(s, i, sine)
        store(c, i, cosine)


@pytest.mark.parametrize("reach", [0.1, 10.0, 3000.0])
def test_sine_and_cosine_of_numbers_and_vectors(reach):
    x = np.concatenate([np.linspace(-reach, reach, 4000), np.arange(-12, 12) * (np.pi / 4)])
    (s, c), (vs, vc) = np.empty((2, x.size)), np.empty((2, x.size))
    turn_numbers(x, s, c)
    turn_vectors(x, vs, vc)
    assert np.array_equal(s, vs) and np.array_equal(c, vc)
    np.testing.assert_allclose(s, np.sin(x), rtol=0, atol=3e-16)
    np.testing.assert_allclose(c, np.cos(x), rtol=0, atol=3e-16)
