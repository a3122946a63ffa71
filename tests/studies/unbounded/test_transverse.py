"""Growth of a small A + B on the chain with A = -B: crossings, and the growth of a full run."""

import numpy as np
import pytest
from latticode.simulation.runs import run_all
from pendula.studies.unbounded.front import linear_front
from pendula.studies.unbounded.transverse import (
    VELOCITIES,
    crossing_of,
    exponents_of,
    solve_transverse,
    velocities,
)
from problems import problem_of

SOLVER = {"name": "dop853", "rtol": 1e-6, "atol": 1e-6}


def problem(omega, end_time):
    return problem_of(
        "fig4_small", half_width=None, omega=omega, end_time=end_time, output_step=1.0,
        solver=SOLVER,
    )  # fmt: skip


def test_the_crossing_is_where_exponents_change_their_sign():
    falling = 0.5 - velocities()
    assert crossing_of(falling, 0.1) == pytest.approx(0.5)
    assert crossing_of(falling + 0.01, 0.1) == pytest.approx(0.51)
    assert crossing_of(falling, 0.6) == 0.0  # too slow to count as growth
    assert crossing_of(np.ones(VELOCITIES), 0.1) == 1.0
    wavy = np.where(np.arange(VELOCITIES) == 2, -0.1, falling)  # the last change counts
    assert crossing_of(wavy, 0.1) == pytest.approx(0.5)


def test_growth_is_fast_at_the_centre_and_falls_to_both_sides_of_the_band():
    """At Omega = 1 by a factor of e within 1 to 2 units of tau, at 5.5 not at all."""
    (fast, slow) = (
        exponents_of(one, 1e-20)["exponents"] for one in (problem(1.0, 80.0), problem(5.5, 80.0))
    )
    assert 0.5 < fast[0] < 1.5 and fast[-1] < 0.0 < fast[VELOCITIES // 2]
    assert np.abs(slow[: VELOCITIES // 2]).max() < 0.03


def test_the_dataset_has_a_second_speed_for_each_omega():
    problems = [problem(omega, 40.0) for omega in (1.0, 5.5)]
    given = {"members": 2, "perturbation": 1e-6, "seed": 1, "run": run_all}
    variables, about = solve_transverse("transverse", problems, 1e-20, **given)
    speeds = [linear_front(one.constants).speed for one in problems]
    assert 0.5 * speeds[0] < variables["second_speed"].values[0] <= speeds[0]
    assert variables["second_speed"].values[1] == 0.0
    assert variables["exponent"].values.shape == (2, VELOCITIES) and about["members"] == 2
