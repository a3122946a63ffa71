"""Lifetimes: when the centre has its share, and what censored lives say."""

import numpy as np
import pytest
from pendula.datasets.netcdf import as_xarray
from pendula.simulation.simulate import simulate
from pendula.studies.chaos import figures, lifetimes
from problems import problem_of

SOLVER = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}


def problem(case="fig4_small", a0=1.0, **changes):
    given = {"solver": SOLVER, "end_time": 20.0, "output_step": 0.1, "initial": {0: (a0, 0.2 * a0)}}
    return problem_of(case, **given | changes)


def test_the_centre_shares_alike_from_the_mean_over_all_pairs_on():
    modulus = np.ones((2, 5, 3))
    modulus[:, 2] = [3.0, 1.0, 0.5]
    assert lifetimes.shares_alike(modulus).tolist() == [False, True, True]


def test_a_life_is_the_same_in_pieces_as_in_one_run():
    case = problem(a0=2.0)
    whole = simulate(case.changed(end_time=10.0, snapshot_every=1))
    first = np.flatnonzero(lifetimes.shares_alike(whole.modulus))[0]
    life = lifetimes.follow(case)
    assert life.time == pytest.approx(whole.tau[first]) and 0 < life.time < 10
    assert 0 < life.drift < 1e-5 and life.work > 0


@pytest.mark.parametrize(("case", "a0"), [("fig4_small", 10.0), ("fig2_large", 5.0)])
def test_a_large_centre_outlasts_the_run_and_a_stable_one_too(case, a0):
    assert lifetimes.follow(problem(case, a0)).time == np.inf


def test_a_rate_that_is_constant_only_after_a_dead_time_is_seen():
    draws = 10.0 + np.random.default_rng(0).exponential(10.0, (40, 200))
    chances = [lifetimes.chance_of_rate(lives, 10.0, 100.0) for lives in draws]
    assert np.mean(np.array(chances) > 0.05) > 0.85
    late = [lifetimes.chance_of_rate(lives, 10.0, 100.0) for lives in draws + 5.0]
    assert max(late) < 0.01
    assert lifetimes.chance_of_rate(np.array([3.0, 4.0]), 10.0, 100.0) == 1.0


def test_one_transition_bounds_a_rate_by_all_the_time_that_was_watched(monkeypatch):
    """Of 64 runs to tau = 50 one changes over from A_0 = 9, at 48.2, and six do from 8."""
    drawn = {8.0: np.full(64, np.inf), 9.0: np.full(64, np.inf)}
    drawn[8.0][:6], drawn[9.0][0] = [35.8, 40.2, 40.4, 42.1, 42.4, 47.9], 48.2
    followed = []

    def follow_members(problem, a0, ratio, tolerance, kind, *_):
        followed.append((a0, tolerance, kind))
        return lifetimes.Lives(drawn[a0], tolerance, 1)

    monkeypatch.setattr(lifetimes, "follow_members", follow_members)
    given, choices = problem(end_time=50.0, output_step=0.5), [[1e-8, "even"], [1e-5, "uneven"]]
    compared = {"amplitude": 9.0, "choices": choices}
    data = as_xarray(
        *lifetimes.measure_lifetimes(given, [8.0, 9.0], 0.2, compared, 1e-7, 64, 10.0, 3)
    )
    # an ensemble that is known is not run again
    assert followed == [(8.0, 1e-8, "even"), (9.0, 1e-8, "even"), (9.0, 1e-5, "uneven")]
    assert data["choice_drift"].values.tolist() == [1e-8, 1e-5]
    assert data["choice_kind"].values.tolist() == ["even", "uneven"]
    rate, low, high = (data[f"rate{end}"].values for end in ("", "_low", "_high"))
    exposed = 64 * 40.0 - np.array([np.sum(50.0 - drawn[8.0][:6]), 1.8])
    assert rate == pytest.approx([6, 1] / exposed)
    assert data["choice_rate"].values.tolist() == [rate[1]] * 2
    assert high[1] == pytest.approx(5.57164 / 2558.2, rel=1e-5)  # Poisson: exp(-m) (1 + m) = 0.025
    assert low[1] == pytest.approx(-np.log(0.975) / 2558.2, rel=1e-5)
    assert low[1] < low[0] < high[1] < high[0]
    shown = figures.draw_lifetimes(figures.gather_lifetimes(data)).axes[1]
    (means,) = (one for one in shown.containers if len(one.lines[0].get_ydata()) == 2)
    assert np.diff(means.lines[0].get_ydata()) > 0


def test_survival_falls_with_each_transition():
    lives, tau = np.array([1.0, 2.5, np.inf, np.inf]), np.arange(4.0)
    share, low, high = lifetimes.surviving(lives, tau)
    assert share.tolist() == [1.0, 0.75, 0.75, 0.5]
    assert (low < share).all() and (high >= share).all()


def test_members_start_from_both_amplitudes_at_the_tolerance_of_their_ensemble():
    given = problem(end_time=12.0)
    ensembles = [(2.0, 1e-6, "even"), (2.0, 1e-9, "even"), (2.0, 1e-6, "uneven")]
    found = [lifetimes.follow_members(given, a0, 0.2, *how, 1e-7, 3, 1) for a0, *how in ensembles]
    assert all(np.isfinite(one.times).all() for one in found)
    alone = lifetimes.follow(problem(a0=2.0, end_time=12.0))
    assert found[1].times == pytest.approx(alone.time, abs=0.3)
    assert found[1].drift < found[0].drift and found[1].work > found[0].work
    assert not np.array_equal(found[0].drift, found[2].drift)
