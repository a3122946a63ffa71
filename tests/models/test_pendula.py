"""The sine of the kernel that moves the pendula; the motion is tested in test_theory_newton."""

from math import pi, sin

import numpy as np
import pytest
from pendula.compiled import kernel
from pendula.models.pendula import sine


@kernel
def sines(x, out):
    for i in range(x.size):
        out[i] = sine(x[i])


@pytest.mark.parametrize("reach", [1.0, 10.0, 3000.0])
def test_sine_of_angles_of_any_size(reach):
    angles = np.linspace(-reach, reach, 4001)
    found, opposite = np.empty((2, angles.size))
    sines(angles, found)
    sines(-angles, opposite)
    np.testing.assert_allclose(found, np.sin(angles), rtol=0, atol=3e-16)
    assert np.array_equal(opposite, -found)


def test_sine_at_the_seams_of_the_reduction():
    seams = np.arange(-9, 10) * (pi / 4)
    found = np.empty_like(seams)
    sines(seams, found)
    np.testing.assert_allclose(found, [sin(x) for x in seams], rtol=0, atol=3e-16)
