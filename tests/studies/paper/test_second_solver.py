"""The second solver: its schemes and steps, and what decides the sentences on it."""

import numpy as np
import pytest
import xarray as xr
from pendula.ledger.criterion import UndecidableError
from pendula.simulation import sweep as sweeps
from pendula.simulation.simulate import simulate
from pendula.studies.paper import claims_second_solver as claims
from pendula.studies.paper.second_solver import DRAWS, SCHEMES, measure
from problems import problem_of

DRAWN = {"size": 1e-7, "seed": 1}
ABOUT = {"case": "fig2_small", "omega": 8.0, "initial": "{}", "solver": "ode45"}


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
    np.testing.assert_allclose(
        measured["step_error"], measured["scheme_difference"][:, 1], rtol=0.1
    )


def test_only_a_case_that_was_followed_is_known_to_be_chaotic():
    tau = np.linspace(0.0, 50.0, 201)
    lyapunov = xr.Dataset(
        {
            "omega": ("case", [8.0]), "initial": ("case", ["{}"]),
            "l2": (["case", "tau"], [1.0 + 0.0 * tau]),
            "log_growth": (["case", "parity", "tau"], [[0.0 * tau, tau]]),
        },
        {"case": ["fig2_small"], "tau": tau},
    )  # fmt: skip
    run = xr.Dataset(attrs=ABOUT)
    assert claims.are_chaotic(lyapunov, [run]) == [True]
    assert claims.are_chaotic(claims.regular(lyapunov), [run]) == [False]
    with pytest.raises(UndecidableError, match="fig2_small"):
        claims.are_chaotic(lyapunov, [run, run.assign_attrs(omega=7.0)])


def members(level):
    """Return 32 members of two kinds; those of the even kind scatter by one about a level."""
    drawn = level + np.random.default_rng(1).normal(size=(2, 1, 32, 1, 2))
    drawn[1] += 100.0
    grid = ("kind", "case", "member", "quantity", "window")
    return xr.Dataset(
        {"l2_level": (grid, drawn), "linf_level": (grid, drawn)},
        {
            "kind": ["even", "uneven"], "case": ["fig2_small"], "quantity": ["pair"],
            "window": ["[10, 30]", "[30, 50]"],
        },
    )  # fmt: skip


def test_a_run_is_one_more_draw_from_the_even_members_after_it_has_diverged():
    tau = np.linspace(0.0, 50.0, 501)
    norms = xr.DataArray(
        np.array([7.0 + 0.0 * tau, 0.0 * tau]),
        {"component": ["A", "B"], "tau": tau}, ("component", "tau"),
    )  # fmt: skip
    run = xr.Dataset({"l2": norms, "linf": norms})
    alike = claims.late_chances(run, members(7.0), "fig2_small", 20.0)
    assert len(alike) == 2 and min(alike) > 0.5
    assert len(claims.late_chances(run, members(7.0), "fig2_small", 5.0)) == 4
    assert max(claims.late_chances(run, members(17.0), "fig2_small", 20.0)) < 1e-3
    with pytest.raises(UndecidableError, match="tau = 40"):
        claims.late_chances(run, members(7.0), "fig2_small", 40.0)


def test_one_norm_of_many_does_not_tell_runs_apart_and_most_of_them_do():
    assert claims.of_most([np.array([0.4, 0.9]), 0.5, 1e-6]) == pytest.approx(4.0 / 3.0 * 0.5)
    assert claims.of_most([0.9, 1e-3, 1e-3, 1e-4]) == pytest.approx(4.0 / 3.0 * 1e-3)
    assert claims.of_most([0.03]) == 0.03
    assert claims.together([np.array([0.4, 0.02]), 0.5]) == pytest.approx(0.06)


def swept(l2, dims=("half_width", "quantity", "statistic", "window")):
    """Return a sweep over eight half-widths, the same by every reading."""
    values = np.reshape(l2, (8, 1, 1, 1)) * np.ones((8, 1, 2, 2))
    return xr.Dataset(
        {"l2": (dims, values), "linf": (dims, values / 4)},
        {
            "half_width": np.arange(5, 45, 5), "quantity": ["pair"], "statistic": ["max", "mean"],
            "window": ["[10, 40]", "[10, 70]"],
        },
    )  # fmt: skip


def test_a_sweep_is_held_to_its_ensemble_point_by_point():
    sweep = swept(10.0 + np.arange(8.0))
    moments = {"l2_mean": sweep["l2"], "l2_deviation": 0.1 * sweep["l2"]}
    ensemble = xr.Dataset(moments).assign(swept_members=8).expand_dims(sweep=["fig6_right"])
    alike = claims.swept_draws("fig6_right", sweep, ensemble)
    assert alike["text"] == [1.0] * 8 and alike["off"] == [0.0]
    other = swept(10.0 + np.arange(8.0) + 9.0 * (np.arange(8) == 3))
    apart = claims.swept_draws("fig6_right", other, ensemble)
    assert np.flatnonzero(np.array(apart["text"]) < 1e-2).tolist() == [3] and apart["off"][0] > 0.6
    assert claims.regular_difference(sweep, other) > 0.6
    brief = sweep.sel(window=["[10, 40]"])
    with pytest.raises(UndecidableError, match=r"no window \[10, 70\]"):
        claims.swept_draws("fig6_right", brief, ensemble)
    with pytest.raises(UndecidableError, match="no ensemble of fig5_left"):
        claims.swept_draws("fig5_left", sweep, ensemble)
    with pytest.raises(UndecidableError, match="fewer than 6"):
        claims.regular_difference(sweep.isel(half_width=slice(0, 3)), sweep)


def test_chains_that_show_one_trajectory_are_one_run():
    sweep = swept([10.0, 12.0, 14.0, 14.001, 13.0, 15.0, 15.0, 15.0])
    sweep = sweep.isel(quantity=0, statistic=0, window=0)
    norms = (sweep[norm].values for norm in ("l2", "linf"))
    assert claims.distinct_runs(norms) == [[0], [1], [2, 3], [4], [5, 6, 7]]


def test_points_without_an_ensemble_are_named():
    sweep = swept(10.0 + np.arange(8.0) + 9.0 * (np.arange(8) == 3))
    ensemble = xr.Dataset({"l2_mean": swept(10.0 + np.arange(8.0))["l2"]})
    ensemble = ensemble.expand_dims(sweep=["fig6_right"])
    assert claims.coverage("fig6_right", sweep, ensemble) == "8 of 8 half-widths of fig6_right"
    said = claims.coverage("fig6_right", sweep, ensemble.isel(half_width=slice(None, None, 2)))
    assert said.startswith("4 of 8 half-widths") and "M = 20 with l2 = 22" in said


def drawn_by_step(own, finer):
    """Return six draws of two sweeps that scatter by a hundredth, the first without scatter."""
    scatter = 1.0 + 0.01 * np.random.default_rng(3).normal(size=(6, 8))
    scatter[0] = 1.0
    by_draw = xr.DataArray(scatter, dims=("draw", "half_width"))
    return xr.concat([by_draw * own, by_draw * finer], "finer_step")


def test_a_sweep_with_draws_of_its_own_is_held_to_the_ensemble_by_its_mean():
    sweep = swept(10.0 + np.arange(8.0))
    moments = {"l2_mean": sweep["l2"], "l2_deviation": 0.02 * sweep["l2"]}
    ensemble = xr.Dataset(moments).assign(swept_members=8).expand_dims(sweep=["fig6_right"])
    own = 1.04 * sweep  # two deviations off: a likely draw, and an unlikely mean
    steps = drawn_by_step(own, sweep)
    by_one = claims.swept_draws("fig6_right", own, ensemble)
    by_all = claims.swept_draws("fig6_right", claims.runs_by_step(steps)[0], ensemble)
    assert claims.together(by_one["text"]) > 0.05 > 1e-2 > claims.together(by_all["text"])
    assert by_all["off"][0] == pytest.approx(0.04, abs=0.02)
    assert claims.chance_by_step("fig6_right", steps) < 1e-2
    assert claims.chance_by_step("fig6_right", drawn_by_step(own, own)) == 1.0


def test_draws_count_only_for_the_sweep_that_the_first_of_them_repeats():
    sweep = swept(10.0 + np.arange(8.0))
    steps = drawn_by_step(sweep, 1.2 * sweep)
    assert claims.is_drawn(sweep, steps)
    assert not claims.is_drawn(1.01 * sweep, steps)
    assert not claims.is_drawn(sweep.isel(half_width=slice(5)), steps)
    assert not claims.is_drawn(sweep.sel(window=["[10, 40]"]), steps)
