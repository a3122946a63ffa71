"""Criteria decide by the limit that they print; cut-offs record that they decide, and can move."""

import math

import pytest
from replication.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Near,
    Verdict,
    WithinFactor,
    judge,
)

HELD = [
    (Below(1.0, "x"), "x < 1", [0.0, 0.999], [1.0, 2.0]),
    (AtMost(1.0, "x"), "x <= 1", [0.0, 1.0], [1.0 + 2e-16, 2.0]),
    (Above(1.0, "x"), "x > 1", [1.001, 2.0], [1.0, 0.0]),
    (AtLeast(1.0, "x"), "x >= 1", [1.0, 2.0], [1.0 - 2e-16, 0.0]),
    (Below(math.inf, "x"), "x < infinity", [0.0, 5.0], [math.inf]),
    (WithinFactor(2.0, "x"), "0.5 < x < 2", [0.51, 1.0, 1.99], [0.5, 2.0, -1.0]),
    (Near(3.0, 0.5, "x"), "x within 0.5 of 3", [2.5, 3.5], [2.4, 3.6]),
    (Near(0.0, 0.5, "x"), "|x| <= 0.5", [-0.5, 0.5], [-0.6, 0.6]),
]


@pytest.mark.parametrize(("criterion", "text", "right", "wrong"), HELD, ids=str)
def test_a_criterion_decides_and_prints_the_same_limit(criterion, text, right, wrong):
    assert str(criterion) == text
    assert all(criterion.holds({"x": value}) for value in right)
    assert not any(criterion.holds({"x": value}) for value in (*wrong, math.nan))


def test_each_number_and_each_part_alone_can_fail():
    both = AllOf(Below(1.0, "a", "b", label="sizes"), Above(0.0, "c_of_d"))
    right = {"a": 0.0, "b": 0.5, "c_of_d": 1.0}
    assert both.holds(right) and str(both) == "sizes < 1, c of d > 0"
    for name in right:
        assert both.failing({**right, name: -1.0 if name == "c_of_d" else 1.0}) == [name]


LOW = Below(1.0, "x", "y")


@pytest.mark.parametrize(
    ("x", "y", "words", "verdict", "because"),
    [
        (0.5, 0.0, (), Verdict.CONFIRMED, ""),
        (0.5, 0.0, ("but",), Verdict.CAVEAT, "but"),
        (1.5, 0.0, ("but", "too large"), Verdict.NOT_REPRODUCED, "too large"),
        (0.5, math.nan, ("but", "too large"), Verdict.UNDECIDED, "unknown: y"),
        (1.5, math.nan, (), Verdict.NOT_REPRODUCED, "x is 1.5, y is nan"),
    ],
)
def test_a_verdict_follows_from_the_criterion_alone(x, y, words, verdict, because):
    finding = judge({"x": x, "y": y}, LOW, *words)
    assert (finding.verdict, finding.because) == (verdict, because)
