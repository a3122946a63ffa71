"""Ensembles: members are runs with draws of their own."""

import numpy as np
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import pair_l2, pair_linf
from pendula.studies.chaos.ensembles import run_members, sweep_members
from problems import problem_of

SOLVER = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
PROBLEM = problem_of("fig4_small", half_width=6, end_time=3.0, output_step=0.5, solver=SOLVER)


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
