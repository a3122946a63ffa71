"""Criteria decide by the limit that they print; cut-offs record that they decide, and can move."""

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
)
from pendula.ledger.cutoff import Cutoff, flips, moving, once, recorded

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
    found = judge({"x": x, "y": y}, LOW, *words)
    assert (found.verdict, found.because) == (verdict, because)


# --- Cut-offs -------------------------------------------------------------------------------------

HALF = Cutoff(0.5, '"about half"')
WHOLE = Cutoff(0.9, '"nearly all"', ideal=1.0)


@pytest.mark.parametrize(("cutoff", "low", "high"), [(HALF, 1 / 3, 2 / 3), (WHOLE, 0.9333, 0.8667)])
def test_a_cutoff_moves_by_a_third_of_its_distance_from_the_ideal(cutoff, low, high):
    for factor, moved in ((2 / 3, low), (4 / 3, high)):
        with moving(cutoff, factor):
            assert float(cutoff) == pytest.approx(moved, abs=1e-4)
            assert {float(HALF), float(WHOLE)} & {0.5, 0.9}  # the other one has not moved
    assert float(cutoff) == cutoff.number


@pytest.mark.parametrize(
    ("value", "moved"),
    [(0.1, []), (0.4, [1 / 3]), (0.6, [2 / 3]), (0.9, [])],
)
def test_a_verdict_flips_only_where_the_number_is_near_its_cutoff(value, moved):
    def decide():
        return str(judge({"x": value}, Below(HALF, "x")).verdict)

    with recorded() as read:
        verdict = decide()
    assert read == {HALF}
    found = flips(verdict, read, decide)
    assert [flip.value for flip in found] == pytest.approx(moved)
    assert all(flip.verdict != verdict and flip.verdict in str(flip) for flip in found)


def test_what_is_measured_once_is_measured_anew_of_other_datasets_and_where_a_cutoff_moves():
    asked = []

    @once
    def measure(data, name):
        asked.append(name)
        return [name, *data]

    @once
    def share(data):
        asked.append("share")
        return data[0] / HALF.value

    data, alike = [1.0], [1.0]
    assert measure(data, "l2") is measure(data, "l2")
    assert measure(data, "linf") == ["linf", 1.0] and measure(alike, "l2") == ["l2", 1.0]
    assert asked == ["l2", "linf", "l2"]
    for _ in range(2):
        with recorded() as read:
            assert share(data) == 2.0
        assert read == {HALF}
        with moving(HALF, 2.0):
            assert share(data) == 1.0
    assert asked[3:] == 3 * ["share"], "once at the cut-off's own value, and at each move"
