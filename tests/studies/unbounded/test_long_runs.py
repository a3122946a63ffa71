"""Ensembles of long runs: their members, and what the tolerance of the solver changes."""

import numpy as np
import pytest
from pendula.studies.unbounded.long_runs import member
from problems import problem_of

LOOSE = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
PROBLEM = problem_of("fig4_small", half_width=None, end_time=40.0, output_step=0.25, solver=LOOSE)
REST = 1e-20


def test_members_differ_by_little_and_are_the_same_every_time():
    drawn = ((1e-6, 2017, 1), (1e-6, 2017, 1), (1e-6, 2017, 2), (1e-6, 1, 1), (1e-3, 2017, 1))
    first, again, second, other, larger = (member(PROBLEM, *one).initial for one in drawn)
    assert member(PROBLEM, 1e-6, 2017, 0) is PROBLEM
    np.testing.assert_array_equal(first, again)
    assert (first != second).all() and (other != first).all()
    np.testing.assert_allclose(larger - PROBLEM.initial, 1e3 * (first - PROBLEM.initial), rtol=1e-8)
    assert first[0, 0] == pytest.approx(1.0, rel=1e-5)
