"""Points from loose to tight, and contestants in turns at the same error, with known times."""

import numpy as np
import pytest
from problems import problem_of

from benchmarks.contestants import PAIRS, Contestant, compare, measure_points

EXACT = np.ones((2, 3), complex)
PROBLEM = problem_of(half_width=1)
ALL = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


def contestant(seconds, accuracies=ALL, faults=(), blanks=()):
    """Return a contestant that errs by what is asked for, in the seconds that `seconds()` gives."""

    def solve(accuracy):
        if accuracy in faults:
            raise RuntimeError("gave up")
        return EXACT + (np.nan if accuracy in blanks else accuracy), seconds()

    return Contestant("made up", np.array(accuracies), lambda problem: solve)


def with_points(solver):
    return solver, measure_points(solver, PROBLEM, EXACT)


def test_who_gives_up_or_returns_no_numbers_has_no_point_there():
    failing = contestant(lambda: 1e-3, faults=(1e-4,), blanks=(1e-8,))
    points = measure_points(failing, PROBLEM, EXACT)
    assert [point.accuracy for point in points] == [1e-6, 1e-10, 1e-12]


def test_the_ratio_is_theirs_over_that_of_our_fastest_below_the_target():
    slow, fast, coarse = map(
        with_points,
        (
            contestant(lambda: 0.25),
            contestant(lambda: 0.05),
            contestant(lambda: 0.01, accuracies=ALL[:2]),
        ),
    )
    ratios = compare(PROBLEM, 1e-10, slow, {"slow": slow, "fast": fast, "coarse": coarse})
    assert ratios == pytest.approx([5.0] * PAIRS)
    # who never gets that far is not compared
    assert compare(PROBLEM, 1e-10, coarse, {"fast": fast}) is None
    assert compare(PROBLEM, 1e-10, fast, {"coarse": coarse}) is None
