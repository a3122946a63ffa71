"""Ensembles: members are runs with draws of their own."""

import numpy as np
from latticode.simulation.runs import run_all
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import pair_l2
from pendula.studies.chaos.ensembles import draw_swept, run_ensembles
from problems import problem_of

SOLVER = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
WINDOWS = [(0.5, 1.0)]
PROBLEM = problem_of("fig4_small", half_width=6, end_time=3.0, output_step=0.5, solver=SOLVER)


def test_half_widths_have_draws_of_their_own():
    long = PROBLEM.changed(end_time=1.0)  # before the ends matter
    drawn = draw_swept(long, [12, 13], 1e-3, 3, 0, "even")
    _, swept = run_ensembles([PROBLEM], drawn, WINDOWS, run_all)
    assert swept["l2"].shape == (6, 3, 2, 1) and [m.half_width for m in drawn[2:4]] == [12, 13]
    assert not np.allclose(swept["l2"][:3], swept["l2"][3:], rtol=1e-9)
    alone = simulate(drawn[4], energy=False)
    np.testing.assert_array_equal(swept["l2"][4, :, 0, 0], pair_l2(alone)[:, 1:].max(axis=1))
