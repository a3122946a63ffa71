"""The one timer: repetitions after a warm-up, pairs in turns, memory, and runs without end."""

import numpy as np
import pytest
from helpers import HANGS

from benchmarks import timing
from benchmarks.timing import (
    Times,
    TooLongError,
    clocked,
    in_turns,
    limit,
    peak_memory,
    repeat,
    timed,
)


def scripted(*seconds):
    """Return a run that takes these times one after the other, and the list of its calls."""
    waiting, calls = iter(seconds), []

    def run():
        calls.append(next(waiting))
        return calls[-1]

    return run, calls


def test_the_result_comes_with_the_seconds(monkeypatch):
    clock = iter([10.0, 10.25, 20.0, 20.5])
    monkeypatch.setattr(timing, "perf_counter", lambda: next(clock))
    assert timed(lambda: "done") == ("done", 0.25)
    assert clocked(lambda: "done")() == 0.5


def test_the_first_run_warms_up_and_does_not_count():
    run, calls = scripted(9.0, 0.1, 0.3, 0.2)
    assert repeat(run, 3) == Times(median=0.2, least=0.1, most=0.3)
    assert len(calls) == 4


def test_what_is_warm_is_not_warmed_up():
    run, calls = scripted(0.1, 0.3, 0.2)
    assert repeat(run, 3, warm=True).most == 0.3 and len(calls) == 3


def test_short_runs_are_repeated_until_they_are_enough():
    run, calls = scripted(*[0.01] * 20)
    repeat(run, 3, 15, enough=0.055)
    assert len(calls) == 1 + 6
    run, calls = scripted(*[0.01] * 20)
    repeat(run, 3, 15, enough=10.0)
    assert len(calls) == 1 + 15


def test_pairs_take_turns_after_a_warm_up():
    order = []

    def run(name, seconds):
        return lambda: order.append(name) or seconds

    ratios = in_turns(run("one", 0.3), run("other", 0.1), turns=3)
    np.testing.assert_allclose(ratios, 3.0)
    assert order[:4] == ["one", "one", "other", "other"] and order[4:] == ["one", "other"] * 3


def test_short_runs_fill_a_block():
    run, calls = scripted(*[0.01] * 100)
    np.testing.assert_allclose(in_turns(run, lambda: 0.05, turns=2, block=0.05), 0.2)
    assert len(calls) == 2 + 2 * 5


def test_the_peak_is_that_of_the_arrays():
    assert 8e5 < peak_memory(lambda: np.ones(100_000)) < 9e5


def test_a_run_without_end_is_broken_off():
    with pytest.raises(TooLongError), limit(0.05):
        while True:
            pass
    with limit(HANGS):
        pass
