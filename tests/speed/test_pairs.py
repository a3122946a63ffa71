"""Contestants in turns at the same error."""

import pytest
from pendula.speed.ladder import climb
from pendula.speed.pairs import LONG, PAIRS, best_of, compare


def test_the_ratio_is_theirs_over_ours_at_the_error_of_the_regime(task, contestant):
    slow, _ = contestant(lambda accuracy: 0.5)
    fast, _ = contestant(lambda accuracy: 0.1)
    found = compare(task, slow, climb(slow, task), {"fast": fast}, {"fast": climb(fast, task)})
    assert found.ours == "fast"
    assert len(found.ratios) == PAIRS
    assert found.ratios == pytest.approx([5.0] * PAIRS)
    # fig2_small is compared at 1e-10; the error of 1e-10 is above it by rounding
    assert found.our_rung.error <= 1e-10 and found.peer_rung.error <= 1e-10


def test_a_long_run_is_paired_less_often(task, contestant):
    slow, _ = contestant(lambda accuracy: 2 * LONG)
    fast, _ = contestant(lambda accuracy: 0.1)
    found = compare(task, slow, climb(slow, task), {"fast": fast}, {"fast": climb(fast, task)})
    assert len(found.ratios) == 3


def test_who_never_gets_that_far_is_not_compared(task, contestant):
    coarse, _ = contestant(lambda accuracy: 0.5, accuracies=(1e-4, 1e-6))
    fast, _ = contestant(lambda accuracy: 0.1)
    ours = {"fast": climb(fast, task)}
    assert compare(task, coarse, climb(coarse, task), {"fast": fast}, ours) is None
    theirs = {"coarse": climb(coarse, task)}
    assert compare(task, fast, ours["fast"], {"coarse": coarse}, theirs) is None


def test_the_best_of_ours_is_the_one_that_gets_there_first(task, contestant):
    tight = climb(contestant(lambda accuracy: 0.2)[0], task)
    loose = climb(contestant(lambda accuracy: 0.1, accuracies=(1e-4,))[0], task)
    assert best_of({"tight": tight, "loose": loose}, 1e-10) == "tight"
    assert best_of({"tight": tight, "loose": loose}, 1e-3) == "loose"
    assert best_of({"loose": loose}, 1e-10) is None
