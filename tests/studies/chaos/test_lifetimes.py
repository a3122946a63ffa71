"""Lifetimes: when the centre has its share, and what is made of accepted lives."""

import numpy as np
import pytest
from latticode.simulation.simulate import simulate
from pendula.studies.chaos import lifetimes
from problems import problem_of

SOLVER = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}


def problem(case="fig4_small", a0=1.0, **changes):
    given = {"solver": SOLVER, "end_time": 20.0, "output_step": 0.1, "initial": {0: (a0, 0.2 * a0)}}
    return problem_of(case, **given | changes)


def test_a_life_is_the_same_in_pieces_as_in_one_run():
    case = problem(a0=2.0)
    whole = simulate(case.changed(end_time=10.0, snapshot_every=1))
    first = np.flatnonzero(lifetimes.shares_alike(whole.modulus))[0]
    time = lifetimes.follow(case)["life"]
    assert time == pytest.approx(whole.tau[first]) and 0 < time < 10


@pytest.mark.parametrize(("case", "a0"), [("fig4_small", 10.0), ("fig2_large", 5.0)])
def test_a_large_centre_outlasts_the_run_and_a_stable_one_too(case, a0):
    assert lifetimes.follow(problem(case, a0)) == {"life": np.inf}


def test_the_centre_shares_alike_from_the_mean_over_all_pairs_on():
    modulus = np.ones((2, 5, 3))
    modulus[:, 2] = [1.5, 1.0, 0.5]
    assert lifetimes.shares_alike(modulus).tolist() == [False, True, True]
