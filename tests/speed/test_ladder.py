"""Climbing from loose to tight."""

import pytest
from pendula.speed import ladder
from pendula.speed.ladder import PATIENCE, Rung, climb, loosest


def test_each_rung_holds_the_time_and_the_error(task, contestant):
    made, _ = contestant(lambda accuracy: 1e-3)
    rungs = climb(made, task)
    assert [rung.accuracy for rung in rungs] == [1e-4, 1e-6, 1e-8, 1e-10, 1e-12]
    for rung in rungs:
        assert rung.error == pytest.approx(rung.accuracy, rel=1e-3)
        assert rung.seconds == rung.least == rung.most == 1e-3


def test_the_time_is_the_median_of_several_runs_after_the_first(task, contestant):
    times = iter([1.0, 0.1, 0.3, 0.2])
    made, calls = contestant(lambda accuracy: next(times), accuracies=(1e-4,))
    assert climb(made, task)[0][1:4] == (0.2, 0.1, 0.3)
    assert len(calls) == 4


def test_who_takes_too_long_is_asked_no_further(task, contestant):
    made, calls = contestant(lambda accuracy: 2 * PATIENCE if accuracy < 1e-5 else 1e-3)
    assert [rung.accuracy for rung in climb(made, task)] == [1e-4, 1e-6]
    assert calls.count(1e-6) == 1  # and a long run is not repeated


def test_who_compiles_in_the_first_run_is_asked_on(task, contestant):
    times = iter([2 * PATIENCE])
    made, calls = contestant(lambda accuracy: next(times, 1e-3))
    rungs = climb(made, task)
    assert len(rungs) == 5 and rungs[0].most == 1e-3
    assert calls[:2] == [1e-4, 1e-4]


def test_a_run_without_end_is_broken_off(task, contestant, monkeypatch):
    def forever(accuracy):
        while accuracy < 1e-5:
            pass
        return 1e-3

    monkeypatch.setattr(ladder, "LIMIT", 0.1)
    made, _ = contestant(forever)
    assert [rung.accuracy for rung in climb(made, task)] == [1e-4]


def test_who_errs_less_than_the_goal_is_asked_no_further(task, contestant):
    made, _ = contestant(lambda accuracy: 1e-3)
    assert [rung.accuracy for rung in climb(made, task, goal=1e-7)] == [1e-4, 1e-6, 1e-8]


def test_who_gives_up_or_returns_no_numbers_has_no_rung_there(task, contestant):
    made, _ = contestant(lambda accuracy: 1e-3, faults=(1e-4,), blanks=(1e-8,))
    assert [rung.accuracy for rung in climb(made, task)] == [1e-6, 1e-10, 1e-12]


def test_the_cheapest_run_that_is_good_enough_counts():
    rungs = [Rung(1e-4, 1.0, 1, 1, 1e-3), Rung(1e-6, 3.0, 3, 3, 9e-6), Rung(1e-8, 2.0, 2, 2, 1e-7)]
    assert loosest(rungs, 1e-5) is rungs[2]
    assert loosest(rungs, 1e-3) is rungs[0]
    assert loosest(rungs, 1e-9) is None
