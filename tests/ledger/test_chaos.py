"""What an ensemble of almost equal data may say, by the shares that spread from changed data."""

import pytest
from made_up_breathers import sensitivity
from pendula.ledger.chaos import FAR_AS_NEAR, almost_equal, joined
from pendula.ledger.criterion import Verdict, judge


def verdict(found) -> Verdict:
    return judge(found.measured, found.criterion, found.caveat).verdict


def test_an_accident_is_told_with_its_shares():
    found = almost_equal(sensitivity(1.0, 0.9, 0.4, 0.1), 1e-6)
    assert verdict(found) == Verdict.CAVEAT
    assert found.measured == {"share_nearby": 0.9}
    for words in ("1e-06 or less", "90%", "changed by 0.1", "10%"):
        assert words in found.caveat
    assert "0.001" not in found.caveat  # its upper limit is a half


def test_what_spreads_whatever_the_change_has_no_caveat():
    assert verdict(almost_equal(sensitivity(1.0, 1.0, 0.9, 0.8), 1e-6)) == Verdict.CONFIRMED


def test_shares_about_a_half_leave_open_what_data_further_away_do():
    found = almost_equal(sensitivity(1.0, 1.0, 0.55, 0.45), 1e-7)
    assert verdict(found) == Verdict.CAVEAT
    assert "within 1e-07" in found.caveat


@pytest.mark.parametrize("shares", [(0.5, 1.0, 1.0, 1.0), (0.1, 0.4, 1.0, 1.0)])
def test_where_data_close_by_do_not_spread_nothing_holds(shares):
    assert verdict(almost_equal(sensitivity(*shares), 1e-7)) == Verdict.NOT_REPRODUCED


def test_a_wider_ensemble_is_held_to_wider_changes():
    given = sensitivity(1.0, 1.0, 0.4, 0.1)
    assert verdict(almost_equal(given, 1e-6)) == Verdict.CAVEAT
    assert verdict(almost_equal(given, 1e-3)) == Verdict.NOT_REPRODUCED


def test_the_smallest_change_stands_for_a_smaller_one():
    found = almost_equal(sensitivity(0.9, 0.2, sizes=(1e-6, 1e-1)), 1e-7)
    assert found.measured == {"share_nearby": 0.9}


def test_the_control_is_refused():
    (change,) = FAR_AS_NEAR.fed.values()
    wrong = change(sensitivity())
    assert verdict(almost_equal(wrong, 1e-7)) == Verdict.NOT_REPRODUCED


def test_caveats_are_joined_without_empty_ones():
    assert joined("", "one", "", "two") == "one; two"
    assert joined("", "") == ""
