"""Points from loose to tight, and contestants in turns at the same error."""

import pytest

from benchmarks.points import (
    PAIRS,
    Point,
    best_of,
    cheapest,
    compare,
    measure_points,
)

TARGET = 1e-10


def test_the_time_is_the_median_of_several_runs_after_the_first(problem, exact, contestant):
    times = iter([0.25, 0.1, 0.3, 0.2])
    made, calls = contestant(lambda accuracy: next(times), accuracies=(1e-4,))
    assert measure_points(made, problem, exact)[0][1:4] == (0.2, 0.1, 0.3)
    assert len(calls) == 4


def test_who_gives_up_or_returns_no_numbers_has_no_point_there(problem, exact, contestant):
    made, _ = contestant(lambda accuracy: 1e-3, faults=(1e-4,), blanks=(1e-8,))
    assert [point.accuracy for point in measure_points(made, problem, exact)] == [
        1e-6,
        1e-10,
        1e-12,
    ]


def test_the_cheapest_run_that_is_good_enough_counts():
    found = [
        Point(1e-4, 1.0, 1, 1, 1e-3),
        Point(1e-6, 3.0, 3, 3, 9e-6),
        Point(1e-8, 2.0, 2, 2, 1e-7),
    ]
    assert cheapest(found, 1e-5) is found[2]
    assert cheapest(found, 1e-3) is found[0]
    assert cheapest(found, 1e-9) is None


@pytest.fixture
def with_points(problem, exact):
    """Return a contestant together with its points."""
    return lambda contestant: (contestant, measure_points(contestant, problem, exact))


def test_the_ratio_is_theirs_over_ours_below_the_target(problem, with_points, contestant):
    slow, _ = contestant(lambda accuracy: 0.25)
    fast, _ = contestant(lambda accuracy: 0.05)
    found = compare(problem, TARGET, with_points(slow), {"fast": with_points(fast)})
    assert found.ours == "fast"
    assert len(found.ratios) == PAIRS
    assert found.ratios == pytest.approx([5.0] * PAIRS)
    # the run at 1e-10 errs by a little more than that, by rounding
    assert found.our_point.error <= 1e-10 and found.peer_point.error <= 1e-10


def test_who_never_gets_that_far_is_not_compared(problem, with_points, contestant):
    coarse, _ = contestant(lambda accuracy: 0.5, accuracies=(1e-4, 1e-6))
    fast, _ = contestant(lambda accuracy: 0.1)
    fast, coarse = with_points(fast), with_points(coarse)
    assert compare(problem, TARGET, coarse, {"fast": fast}) is None
    assert compare(problem, TARGET, fast, {"coarse": coarse}) is None


def test_the_best_of_ours_is_the_one_that_gets_there_first(problem, exact, contestant):
    tight = measure_points(contestant(lambda accuracy: 0.2)[0], problem, exact)
    loose = measure_points(contestant(lambda accuracy: 0.1, accuracies=(1e-4,))[0], problem, exact)
    assert best_of({"tight": tight, "loose": loose}, 1e-10) == "tight"
    assert best_of({"tight": tight, "loose": loose}, 1e-3) == "loose"
    assert best_of({"loose": loose}, 1e-10) is None
