"""Doubles around balls: never inside them, and next to them."""

import math
from fractions import Fraction

import pytest
from flint import arb
from pendula.studies.certified.balls import decimal, lower, precision, upper, within


@pytest.mark.parametrize("value", [0.1, -0.1, 1 / 3, 5.0, 1e-300, -1e300])
def test_ends_are_doubles_on_the_outer_side(value):
    with precision():
        third = arb(value) / 3
        exact = Fraction(value) / 3
        assert Fraction(lower(third)) <= exact <= Fraction(upper(third))
        assert upper(third) <= math.nextafter(lower(third), math.inf)


def test_an_exact_double_is_both_of_its_ends():
    assert lower(arb(0.375)) == upper(arb(0.375)) == 0.375


def test_a_decimal_is_what_is_printed_and_not_the_double():
    with precision():
        assert (10 * decimal(0.1) - 1).contains(0)
        assert not (10 * arb(0.1) - 1).contains(0)


def test_a_radius_is_kept():
    with precision():
        ball = within(1.0, 1e-10)
        assert ball.contains(arb(1.0) + arb(1e-10)) and lower(ball) <= 1.0 - 1e-10


def test_what_is_not_finite_has_no_end():
    assert upper(arb.pos_inf()) == math.inf and lower(arb.nan()) == -math.inf
