"""What an ensemble of almost equal data may say, by the shares that spread from changed data."""

import pytest
from made_up_breathers import sensitivity
from pendula.ledger.chaos import FAR_AS_NEAR, almost_equal, joined
from pendula.ledger.criterion import Above, Verdict


@pytest.mark.parametrize(
    ("shares", "within", "verdict"),
    [
        ((1.0, 1.0, 0.9, 0.8), 1e-6, Verdict.CONFIRMED),
        ((1.0, 1.0, 0.55, 0.45), 1e-7, Verdict.CAVEAT),  # open what data further away do
        ((1.0, 1.0, 0.4, 0.1), 1e-6, Verdict.CAVEAT),
        ((1.0, 1.0, 0.4, 0.1), 1e-3, Verdict.NOT_REPRODUCED),  # a wider ensemble needs more
        ((0.5, 1.0, 1.0, 1.0), 1e-7, Verdict.NOT_REPRODUCED),
        ((0.1, 0.4, 1.0, 1.0), 1e-7, Verdict.NOT_REPRODUCED),
    ],
)
def test_most_data_as_close_as_the_ensemble_must_spread(shares, within, verdict):
    near = almost_equal(sensitivity(*shares), within)
    assert near.judge({}).verdict == verdict
    assert near.judge({"x": 0.0}, Above(1.0, "x")).verdict == Verdict.NOT_REPRODUCED
    assert near.judge({"x": 2.0}, Above(1.0, "x"), caveat="but").because.startswith("but") == (
        verdict != Verdict.NOT_REPRODUCED
    )


def test_an_accident_is_reported_with_its_shares():
    found = almost_equal(sensitivity(1.0, 0.9, 0.4, 0.1), 1e-6)
    assert found.measured == {"share_nearby": 0.9}
    for words in ("1e-06 or less", "90%", "changed by 0.1", "10%"):
        assert words in found.caveat
    assert "0.001" not in found.caveat  # its upper limit is a half
    assert "within 1e-07" in almost_equal(sensitivity(1.0, 1.0, 0.55, 0.45), 1e-7).caveat


def test_the_smallest_change_stands_for_a_smaller_one():
    found = almost_equal(sensitivity(0.9, 0.2, sizes=(1e-6, 1e-1)), 1e-7)
    assert found.measured == {"share_nearby": 0.9}


def test_the_control_is_refused():
    (change,) = FAR_AS_NEAR.fed.values()
    wrong = almost_equal(change(sensitivity()), 1e-7)
    assert wrong.judge({}).verdict == Verdict.NOT_REPRODUCED


def test_caveats_are_joined_without_empty_ones():
    assert joined("", "one", "", "two") == "one; two" and joined("", "") == ""
