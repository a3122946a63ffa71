"""Ensembles of sweeps: members are runs with draws of their own."""

import numpy as np
import pytest
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import pair_l2
from pendula.studies.chaos.ensembles import draw_swept, measure_ensembles, measure_second_solver
from pendula.studies.chaos.settings import second_solver_steps
from problems import problem_of

SOLVER = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
PROBLEM = problem_of("fig4_small", half_width=6, end_time=1.0, output_step=0.25, solver=SOLVER)


def test_half_widths_have_draws_of_their_own_and_each_reading_its_window():
    settings = {"problem": PROBLEM.plain(), "members": 3, "windows": [(0.5, 1.0), (0.25, 0.5)]}
    swept = {"a": settings | {"half_widths": [12]}, "b": settings | {"half_widths": [13]}}
    data = measure_ensembles(swept, 1e-3, 0).make()  # before the ends matter
    means = data["l2_mean"].sel(reading="text")
    assert np.isnan(means.sel(sweep="a", half_width=13)) and means.notnull().sum() == 2
    assert not np.isclose(means.sel(sweep="a", half_width=12), means.sel(sweep="b", half_width=13))
    norms = [pair_l2(simulate(member))[2] for member in draw_swept(PROBLEM, [13], 1e-3, 3, 0)]
    expected = [
        np.mean([norm[2:].max() for norm in norms]),
        np.mean([norm[1:3].mean() for norm in norms]),
    ]
    np.testing.assert_allclose(data["l2_mean"].sel(sweep="b", half_width=13), expected, rtol=1e-3)


def test_runs_of_the_second_solver_have_its_steps_and_draws_of_their_own():
    steps = [0.05, 0.125]
    first = PROBLEM.plain()
    second = [
        first
        | {"solver": {"name": "crank_nicolson", "step": step, "tolerance": 1e-13, "iterations": 50}}
        for step in steps
    ]
    windows = [(0.5, 1.0), (0.25, 0.5)]
    data = measure_second_solver(first, second, [3, 4], windows, 1e-3, 2, 5, seed=1).make()
    assert data["solver_step"].values.tolist() == steps and data.attrs["window"] == "[0.5, 1]"
    assert data["first_l2"].shape == (2, 5) and data["l2"].shape == (2, 2, 2)
    alone = draw_swept(PROBLEM.of(second[1]), [4], 1e-3, 2, seed=1 + 2)
    expected = [pair_l2(simulate(member))[2][2:].max() for member in alone]
    np.testing.assert_array_equal(data["l2"].sel(solver_step=0.125, half_width=4), expected)
    drawn = np.concatenate([data[name].values.ravel() for name in ("l2", "first_l2")])
    assert len(np.unique(drawn)) == drawn.size == 18


@pytest.mark.parametrize(
    ("step", "steps"), [(0.0025, [0.0025, 0.0125]), (0.0125, [0.0125]), (0.02, [0.0125, 0.02])]
)
def test_steps_of_the_second_solver_rise_and_none_comes_twice(step, steps):
    """A coordinate of a dataset that did not rise would tell its readers nothing."""
    assert second_solver_steps(step, 0.025) == steps
