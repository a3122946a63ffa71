"""Lifetimes: when the centre has its share, and what is made of accepted lives."""

import numpy as np
import pytest
from accepted import dataset
from pendula.datasets.netcdf import as_xarray
from pendula.simulation.simulate import simulate
from pendula.studies.chaos import lifetimes
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
    time, drift, work = lifetimes.follow(case)
    assert time == pytest.approx(whole.tau[first]) and 0 < time < 10
    assert 0 < drift < 1e-5 and work > 0


@pytest.mark.parametrize(("case", "a0"), [("fig4_small", 10.0), ("fig2_large", 5.0)])
def test_a_large_centre_outlasts_the_run_and_a_stable_one_too(case, a0):
    assert lifetimes.follow(problem(case, a0))[0] == np.inf


def test_accepted_lives_are_reduced_as_accepted(monkeypatch):
    """An ensemble that is known is not run again."""
    known, followed = dataset("checks/lifetimes"), []
    amplitudes = known["start_amplitude"].values.tolist()

    def follow_members(problem, a0, ratio, tolerance, kind, *_):
        followed.append((a0, tolerance, kind))
        one = known.sel(start_amplitude=a0)
        return lifetimes.Lives(one["life"].values, one["relative_drift"].item(), int(one["work"]))

    monkeypatch.setattr(lifetimes, "follow_members", follow_members)
    given = problem(end_time=float(known["tau"][-1]))
    again = {"amplitude": amplitudes[-1], "choices": [[1e-8, "even"], [1e-5, "uneven"]]}
    numbers = (known.attrs[name] for name in ("perturbation", "members", "settled", "seed"))
    made = as_xarray(*lifetimes.measure_lifetimes(given, amplitudes, 0.2, again, *numbers))
    main = [(a0, 1e-8, "even") for a0 in amplitudes]
    assert followed == [*main, (amplitudes[-1], 1e-5, "uneven")]
    for name, one in made.data_vars.items():
        if not name.startswith(("choice", "compared")):
            np.testing.assert_allclose(one, known[name], rtol=1e-5, err_msg=name)
    assert made["choice_rate"].values.tolist() == [made["rate"].values[-1]] * 2
    assert made["choice_kind"].values.tolist() == ["even", "uneven"]


def test_members_start_from_both_amplitudes_at_the_tolerance_of_their_ensemble():
    given = problem(end_time=12.0)
    ensembles = [(2.0, 1e-6, "even"), (2.0, 1e-9, "even"), (2.0, 1e-6, "uneven")]
    found = [lifetimes.follow_members(given, a0, 0.2, *how, 1e-7, 3, 1) for a0, *how in ensembles]
    alone, *_ = lifetimes.follow(problem(a0=2.0, end_time=12.0))
    assert found[1].times == pytest.approx(alone, abs=0.3)
    assert found[1].drift < found[0].drift and found[1].work > found[0].work
    assert not np.array_equal(found[0].drift, found[2].drift)
