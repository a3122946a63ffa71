"""The second solver: its schemes and steps, and what the claims make of chances."""

import numpy as np
import pytest
from accepted import dataset
from pendula.simulation import sweep as sweeps
from pendula.simulation.simulate import simulate
from pendula.studies.paper.claims_second_solver import distinct_runs, is_drawn, of_most, together
from pendula.studies.paper.second_solver import DRAWS, SCHEMES, measure
from problems import problem_of

DRAWN = {"size": 1e-7, "seed": 1}


@pytest.fixture(scope="module")
def measured():
    controls = {"name": "crank_nicolson", "step": 0.01, "tolerance": 1e-13, "iterations": 50}
    problem = problem_of("fig2_small", half_width=6, end_time=2.0, output_step=0.02)
    second = problem.changed(solver=controls)
    firsts = {"fig2_small": simulate(problem)}
    variables, about = measure({"fig2_small": second}, firsts, second, [4, 6], [(1.0, 2.0)], DRAWN)
    assert about["configured_step"] == 0.01 and "solver_step" not in about
    return {name: np.squeeze(variables[name].values) for name in variables}


def test_every_scheme_is_of_second_order_and_one_keeps_the_energy(measured):
    assert tuple(measured["scheme"]) == SCHEMES
    assert measured["step"].tolist() == [0.02, 0.01, 0.005]
    for name in ("scheme_difference", "readings_difference"):
        ratios = measured[name][..., :-1] / measured[name][..., 1:]
        np.testing.assert_allclose(ratios, 4.0, rtol=0.15)
    drifts = dict(zip(SCHEMES, measured["scheme_drift"], strict=True))
    assert drifts.pop("delfour_fortin_payre").max() < 1e-8
    assert all(drift.min() > 1e-5 for drift in drifts.values())


def test_all_draws_of_a_sweep_tend_to_that_of_the_first_solver_with_the_step(measured):
    l2 = measured["l2"]  # (finer step, draw, half-width, quantity, statistic)
    assert measured["finer_step"].tolist() == [0.01, 0.0025] and l2.shape == (2, DRAWS, 2, 3, 2)
    spread = np.ptp(l2, axis=1)
    assert (spread > 0.0).all() and (spread < 1e-5).all()  # of data changed by 1e-7
    problem = problem_of("fig2_small", end_time=2.0, output_step=0.02)
    exact = np.squeeze(sweeps.sweep(problem, [4, 6], [(1.0, 2.0)]).l2)
    assert l2[0, 0] - exact == pytest.approx(16.0 * (l2[1, 0] - exact), rel=0.05)


def test_the_error_by_the_step_is_estimated_without_the_solution(measured):
    estimated, found = measured["step_error"], measured["scheme_difference"][:, 1]
    np.testing.assert_allclose(estimated, found, rtol=0.1)


def test_one_norm_of_many_does_not_tell_runs_apart_and_most_of_them_do():
    assert of_most([np.array([0.4, 0.9]), 0.5, 1e-6]) == pytest.approx(4.0 / 3.0 * 0.5)
    assert of_most([0.9, 1e-3, 1e-3, 1e-4]) == pytest.approx(4.0 / 3.0 * 1e-3)
    assert of_most([0.03]) == 0.03
    assert together([np.array([0.4, 0.02]), 0.5]) == pytest.approx(0.06)


def test_chains_that_show_one_trajectory_are_one_run():
    l2 = np.array([10.0, 12.0, 14.0, 14.001, 13.0, 15.0, 15.0, 15.0])
    assert distinct_runs([l2, l2 / 4]) == [[0], [1], [2, 3], [4], [5, 6, 7]]


def test_draws_count_only_for_the_sweep_that_the_first_of_them_repeats():
    sweep, steps = dataset("sweeps/fig6_right.crank_nicolson"), dataset("checks/second_solver")
    assert is_drawn(sweep, steps)
    assert not is_drawn(1.01 * sweep[["l2", "linf"]], steps)
    assert not is_drawn(sweep.isel(half_width=slice(5)), steps)
