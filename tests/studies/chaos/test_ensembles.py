"""Ensembles: perturbed data keep what they must, and statistics are those of NumPy."""

import numpy as np
import pytest
from pendula.problem import on_sites
from pendula.simulation.ensembles import perturb, perturb_unevenly
from pendula.simulation.simulate import simulate
from pendula.simulation.sweep import pair_l2
from pendula.studies.chaos import ensembles
from problems import problem_of

SOLVER = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
PROBLEM = problem_of("fig4_small", half_width=6, end_time=3.0, output_step=0.5, solver=SOLVER)


def test_even_data_stay_even():
    initial = on_sites({0: (1, 2), 2: (3, 4j), -2: (3, 4j)})
    drawn = perturb(initial, 1e-3, np.random.default_rng(0))
    np.testing.assert_array_equal(drawn, drawn[:, ::-1])
    assert (drawn[:, [0, 2]] != initial[:, [0, 2]]).all() and (drawn[:, 1] == 0).all()


def test_the_perturbation_has_the_relative_size_asked_for():
    initial = np.repeat([[5.0], [0.2j]], 999, axis=1)
    drawn = perturb(initial, 1e-4, np.random.default_rng(0))
    relative = (drawn / initial - 1)[:, 499:] / 1e-4
    assert np.std(np.real(relative)) == pytest.approx(1, abs=0.1)
    assert np.std(np.imag(relative)) == pytest.approx(1, abs=0.1)


def test_without_perturbation_every_member_is_the_run_itself():
    l2, _ = ensembles.run_members(PROBLEM, 0.0, 2)
    np.testing.assert_array_equal(l2, [pair_l2(simulate(PROBLEM))] * 2)


def test_members_differ_and_a_seed_gives_the_same_again():
    one, _ = ensembles.run_members(PROBLEM, 1e-3, 3, seed=5)
    again, _ = ensembles.run_members(PROBLEM, 1e-3, 3, seed=5)
    other, _ = ensembles.run_members(PROBLEM, 1e-3, 3, seed=6)
    np.testing.assert_array_equal(one, again)
    assert len(np.unique(np.concatenate([one, other])[:, 2, -1])) == 6


def test_a_swept_ensemble_has_the_shape_of_a_sweep_for_each_member():
    l2, linf = ensembles.sweep_members(PROBLEM, [2, 4], [(1.0, 3.0)], 1e-3, 3)
    assert l2.shape == linf.shape == (3, 2, 3, 2, 1)
    assert np.all(l2.std(axis=0) > 0)


def test_uneven_data_are_not_even_and_their_neighbours_move_a_little():
    initial = on_sites({0: (5, 1)})
    drawn = perturb_unevenly(initial, 1e-6, np.random.default_rng(0))
    assert drawn.shape == (2, 3)
    np.testing.assert_allclose(drawn[:, 1], initial[:, 0], rtol=1e-5)
    beside = np.abs(drawn[:, [0, 2]])
    assert (beside > 1e-8).all() and (beside < 5e-5).all() and len(np.unique(beside)) == 4


def test_uneven_members_leave_the_even_ones():
    even, uneven = (
        ensembles.run_members(PROBLEM, 1e-3, 2, seed=5, kind=kind)[0] for kind in ("even", "uneven")
    )
    assert even.shape == uneven.shape and not np.allclose(even, uneven, rtol=1e-6)


def test_half_widths_have_draws_of_their_own():
    long = PROBLEM.changed(end_time=1.0)  # before the ends matter
    l2, _ = ensembles.sweep_members(long, [12, 13], [(0.5, 1.0)], 1e-3, 2)
    assert not np.allclose(l2[:, 0], l2[:, 1], rtol=1e-9)
