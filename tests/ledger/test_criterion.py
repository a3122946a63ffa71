"""Criteria decide by the limit that they print, and refuse what is not a number."""

import math

import pytest
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Levels,
    Near,
    NeverLevels,
    Verdict,
    WithinFactor,
    judge,
    plain,
)

HELD = [
    (Below(1.0, "x"), "x < 1", [0.0, 0.999], [1.0, 2.0]),
    (AtMost(1.0, "x"), "x <= 1", [0.0, 1.0], [1.0 + 2e-16, 2.0]),
    (Above(1.0, "x"), "x > 1", [1.001, 2.0], [1.0, 0.0]),
    (AtLeast(1.0, "x"), "x >= 1", [1.0, 2.0], [1.0 - 2e-16, 0.0]),
    (WithinFactor(2.0, "x"), "0.5 < x < 2", [0.51, 1.0, 1.99], [0.5, 2.0, -1.0]),
    (Near(3.0, 0.5, "x"), "x within 0.5 of 3", [2.5, 3.5], [2.4, 3.6]),
    (Near(0.0, 0.5, "x"), "|x| <= 0.5", [-0.5, 0.5], [-0.6, 0.6]),
    (Levels("x", says="its start"), "its start is finite", [0.0, 5.0], [math.inf, -math.inf]),
    (NeverLevels("x", says="its start"), "its start is infinite", [math.inf], [0.0, 5.0]),
]


@pytest.mark.parametrize(("criterion", "text", "right", "wrong"), HELD, ids=lambda one: str(one))
def test_a_criterion_decides_and_prints_the_same_limit(criterion, text, right, wrong):
    assert str(criterion) == text
    assert all(criterion.holds({"x": value}) for value in right)
    assert not any(criterion.holds({"x": value}) for value in (*wrong, math.nan))


def test_each_number_and_each_part_alone_can_fail():
    both = AllOf(Below(1.0, "a", "b", says="sizes"), Above(0.0, "c_of_d"))
    right = {"a": 0.0, "b": 0.5, "c_of_d": 1.0}
    assert both.holds(right) and str(both) == "sizes < 1, c of d > 0"
    for name in right:
        assert both.failing({**right, name: -1.0 if name == "c_of_d" else 1.0}) == [name]


def test_a_verdict_follows_from_the_criterion_alone():
    low = Below(1.0, "x")
    assert judge({"x": 0.5}, low).verdict == Verdict.CONFIRMED
    assert judge({"x": 0.5}, low, "but").verdict == Verdict.CAVEAT
    found = judge({"x": 1.5}, low, "but", "too large")
    assert found.verdict == Verdict.NOT_REPRODUCED and found.because == "too large"


def test_what_is_unknown_is_neither_confirmed_nor_refuted():
    low = Below(1.0, "x", "y")
    found = judge({"x": 0.5, "y": math.nan}, low, "but", "too large")
    assert found.verdict == Verdict.UNDECIDED and found.because == "unknown: y"
    assert judge({"x": 1.5, "y": math.nan}, low).verdict == Verdict.NOT_REPRODUCED


@pytest.mark.parametrize(
    ("limit", "text"), [(1.0000001, "1.0000001"), (1 / 3, "0.3333"), (2e-6, "2e-06"), (0, "0")]
)
def test_limits_are_printed_as_they_are(limit, text):
    assert plain(limit) == text
