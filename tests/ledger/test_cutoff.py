"""A cut-off records that it decides, and a verdict that hangs on it is found by moving it."""

import pytest
from pendula.ledger.criterion import Below, judge
from pendula.ledger.cutoff import Cutoff, flips, moving, once, recorded

HALF = Cutoff(0.5, '"about half"')
WHOLE = Cutoff(0.9, '"nearly all"', ideal=1.0)


def verdict_of(value, cutoff=HALF):
    return lambda: str(judge({"x": value}, Below(cutoff, "x")).verdict)


def flips_of(decide):
    with recorded() as read:
        verdict = decide()
    return flips(verdict, read, decide)


def test_a_cutoff_is_a_number_that_records_its_reading():
    with recorded() as read:
        assert float(HALF) == 0.5
    assert read == {HALF}
    assert float(WHOLE) == 0.9 and read == {HALF}  # nobody records any more


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
    found = flips_of(verdict_of(value))
    assert [flip.value for flip in found] == pytest.approx(moved)
    for flip in found:
        assert flip.verdict != verdict_of(value)()
        assert flip.verdict in str(flip) and "in place of 0.5" in str(flip)


def test_an_inner_cutoff_counts_though_no_criterion_prints_it():
    def decide():
        return "confirmed" if WHOLE.value < 0.92 else "not reproduced"

    (flip,) = flips_of(decide)
    assert flip.verdict == "not reproduced" and flip.value == pytest.approx(1 - 0.2 / 3)


def test_the_same_datasets_are_measured_once_and_others_anew():
    asked = []

    @once
    def measure(data, name):
        asked.append(name)
        return [name, *data]

    data, alike = [1.0], [1.0]
    assert measure(data, "l2") is measure(data, "l2")
    assert measure(data, "linf") == ["linf", 1.0] and measure(alike, "l2") == ["l2", 1.0]
    assert asked == ["l2", "linf", "l2"]


def test_what_reads_a_cutoff_is_measured_at_each_of_its_values():
    cutoff = Cutoff(3.0, "a test")
    share = once(lambda data: data[0] / cutoff.value)
    data = [6.0]
    with recorded() as read:
        assert share(data) == 2.0
    assert read == {cutoff}
    with moving(cutoff, 2.0):
        assert share(data) == 1.0
