"""Perturbed data: how large the changes are, and where."""

import numpy as np
import pytest
from latticode.equations.ensembles import perturb, perturb_unevenly
from latticode.equations.initial_values import on_sites


def test_the_perturbation_has_the_required_relative_size():
    initial = np.repeat([[5.0], [0.2j]], 999, axis=1)
    drawn = perturb(initial, 1e-4, np.random.default_rng(0))
    relative = (drawn / initial - 1)[:, 499:] / 1e-4
    assert np.std([relative.real, relative.imag], axis=(1, 2)) == pytest.approx([1, 1], abs=0.1)


def test_uneven_data_are_not_even_and_their_neighbours_move_a_little():
    initial = on_sites({0: (5, 1)})
    drawn = perturb_unevenly(initial, 1e-6, np.random.default_rng(0))
    assert drawn.shape == (2, 3)
    np.testing.assert_allclose(drawn[:, 1], initial[:, 0], rtol=1e-5)
    moved = np.abs(drawn[:, [0, 2]])
    assert (moved > 1e-8).all() and (moved < 5e-5).all() and len(np.unique(moved)) == 4
