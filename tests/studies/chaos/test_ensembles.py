"""Ensembles: perturbed data keep what they must, and members are runs with draws of their own."""

import numpy as np
import pytest
from latticode.simulation.ensembles import perturb, perturb_unevenly
from latticode.simulation.problem import on_sites
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import pair_l2, pair_linf
from pendula.studies.chaos.ensembles import run_members, sweep_members
from problems import problem_of

SOLVER = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
PROBLEM = problem_of("fig4_small", half_width=6, end_time=3.0, output_step=0.5, solver=SOLVER)


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
    beside = np.abs(drawn[:, [0, 2]])
    assert (beside > 1e-8).all() and (beside < 5e-5).all() and len(np.unique(beside)) == 4


def test_without_perturbation_every_member_is_the_run_itself():
    run = simulate(PROBLEM)
    found = run_members(PROBLEM, 0.0, 2, 0, "even")
    np.testing.assert_array_equal(found, [[pair_l2(run)] * 2, [pair_linf(run)] * 2])


def test_members_differ_by_seed_and_kind_and_are_the_same_again():
    drawn = [(5, "even"), (5, "even"), (6, "even"), (5, "uneven")]
    one, again, *others = (run_members(PROBLEM, 1e-3, 2, *each)[0] for each in drawn)
    np.testing.assert_array_equal(one, again)
    assert len(np.unique([one[:, 2, -1], *(other[:, 2, -1] for other in others)])) == 6


def test_half_widths_have_draws_of_their_own():
    long = PROBLEM.changed(end_time=1.0)  # before the ends matter
    swept = sweep_members(long, [12, 13], [(0.5, 1.0)], 1e-3, 3, 0, "even")
    assert swept.shape == (2, 3, 2, 3, 2, 1)
    assert not np.allclose(swept[:, :, 0], swept[:, :, 1], rtol=1e-9)
