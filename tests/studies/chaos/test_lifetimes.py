"""Lifetimes: when the centre has its share, and what censored lives say."""

import numpy as np
import pytest
from pendula.datasets.netcdf import as_xarray
from pendula.simulation.simulate import simulate
from pendula.studies.chaos import lifetimes, lifetimes_figure
from problems import problem_of

SOLVER = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}


def problem(**changes):
    return problem_of(
        "fig4_small", **{"solver": SOLVER, "end_time": 20.0, "output_step": 0.1} | changes
    )


def test_the_centre_shares_alike_from_the_mean_over_all_pairs_on():
    modulus = np.ones((2, 5, 3))
    modulus[:, 2] = [3.0, 1.0, 0.5]
    assert lifetimes.shares_alike(modulus).tolist() == [False, True, True]


def test_a_life_is_the_same_in_pieces_as_in_one_run():
    case = lifetimes.localised(problem(), 2.0, 0.2)
    whole = simulate(case.changed(end_time=10.0, snapshot_every=1))
    first = np.flatnonzero(lifetimes.shares_alike(whole.modulus))[0]
    life = lifetimes.follow(case)
    assert life.time == pytest.approx(whole.tau[first]) and 0 < life.time < 10
    assert 0 < life.drift < 1e-5 and life.work > 0


def test_a_large_centre_outlasts_the_run_and_a_stable_one_too():
    assert lifetimes.follow(lifetimes.localised(problem(), 10.0, 0.2)).time == np.inf
    stable = problem_of("fig2_large", solver=SOLVER, end_time=20.0, output_step=0.1)
    assert lifetimes.follow(stable).time == np.inf


def test_a_rate_that_is_constant_only_after_a_dead_time_is_told():
    draws = 10.0 + np.random.default_rng(0).exponential(10.0, (40, 200))
    chances = [lifetimes.chance_of_rate(lives, 10.0, 100.0) for lives in draws]
    assert np.mean(np.array(chances) > 0.05) > 0.85
    late = [lifetimes.chance_of_rate(lives, 10.0, 100.0) for lives in draws + 5.0]
    assert max(late) < 0.01
    assert lifetimes.chance_of_rate(np.array([3.0, 4.0]), 10.0, 100.0) == 1.0


def test_one_transition_bounds_a_rate_by_all_the_time_that_was_watched():
    """Of 64 runs to tau = 50 one changes over from A_0 = 9, at 48.2, and six do from 8."""
    given, lives = problem(end_time=50.0, output_step=0.5), np.full((2, 64), np.inf)
    lives[0, :6], lives[1, 0] = [35.8, 40.2, 40.4, 42.1, 42.4, 47.9], 48.2
    drawn = {8.0: lives[0], 9.0: lives[1]}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lifetimes, "follow_members", lambda one, *_: [
            lifetimes.Life(time, 0.0, 0) for time in drawn[float(abs(one.initial[0]).max())]
        ])  # fmt: skip
        data = as_xarray(*lifetimes.measure_lives(given, [8.0, 9.0], 0.2, 1e-7, 64, 10.0, 3))
    rate, low, high = (data[f"rate{end}"].values for end in ("", "_low", "_high"))
    exposed = 64 * 40.0 - np.array([np.sum(50.0 - lives[0, :6]), 1.8])
    assert rate == pytest.approx([6, 1] / exposed)
    assert high[1] == pytest.approx(5.57164 / 2558.2, rel=1e-5)  # Poisson: exp(-m) (1 + m) = 0.025
    assert low[1] == pytest.approx(-np.log(0.975) / 2558.2, rel=1e-5)
    assert low[1] < low[0] < high[1] < high[0]
    shown = lifetimes_figure.draw_lifetimes(lifetimes_figure.gather_lifetimes(data)).axes[1]
    (means,) = (one for one in shown.containers if len(one.lines[0].get_ydata()) == 2)
    assert np.diff(means.lines[0].get_ydata()) > 0


def test_survival_falls_with_each_transition():
    lives, tau = np.array([1.0, 2.5, np.inf, np.inf]), np.arange(4.0)
    share, low, high = lifetimes.surviving(lives, tau)
    assert share.tolist() == [1.0, 0.75, 0.75, 0.5]
    assert (low < share).all() and (high >= share).all()


def test_the_dataset_has_every_amplitude_and_every_choice():
    given = problem(end_time=12.0)
    contents = lifetimes.measure_lives(given, [2.0, 7.0], 0.2, 1e-7, 3, 10.0, 1)
    choices = [(1e-6, "even"), (1e-6, "uneven")]
    numerics = lifetimes.compare_numerics(
        lifetimes.localised(given, 7.0, 0.2), choices, 1e-7, 3, 10.0, 1, contents[0]
    )
    data = as_xarray(contents[0] | numerics, contents[1])
    assert data["life"].shape == (2, 3) and np.isfinite(data["life"][0]).all()
    assert data["median"][0] < data["median"][1]
    assert data["choice_kind"].values.tolist() == ["even", "uneven"]
    assert data["compared_amplitude"] == 7.0


def test_an_ensemble_that_is_known_is_not_run_again(monkeypatch):
    given, drawn = problem(end_time=12.0), (1e-7, 3, 10.0, 1)
    lives, _ = lifetimes.measure_lives(given, [2.0, 7.0], 0.2, *drawn)
    compared, own = lifetimes.localised(given, 7.0, 0.2), [(1e-8, "even")]
    again = lifetimes.compare_numerics(lifetimes.localised(given, 7.0, 0.2), own, *drawn, {
        **lives, "start_amplitude": lives["start_amplitude"]._replace(values=[2.0, 8.0])
    })  # fmt: skip
    monkeypatch.delattr(lifetimes, "follow_members")
    known = lifetimes.compare_numerics(compared, own, *drawn, lives)
    for name, one in again.items():
        np.testing.assert_array_equal(known[name].values, one.values)
