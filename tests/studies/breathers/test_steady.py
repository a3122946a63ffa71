"""Steady states: closed forms of one pair, the chain, its spectrum, and where there is none."""

import pytest
from latticode.localised.breathers import NoStateError, exponents
from pendula.models.pairs import FAMILIES, pair
from pendula.models.steady import localised
from pendula.problem import Constants

REAL, EQUAL, ASYMMETRIC, IMAGINARY, ASYMMETRIC_IMAGINARY = FAMILIES


def numbers(epsilon=1.0, gamma=1.0, omega=-4.0):
    return Constants(epsilon=epsilon, gamma=gamma, omega=omega)


def test_a_family_of_one_pair_ends_where_its_pitchfork_or_zero_is():
    """At Omega = 2 gamma, 0, -gamma, -2 gamma and -3 gamma."""
    for family, end in zip(FAMILIES, (2.0, 0.0, -1.0, -2.0, -3.0), strict=True):
        assert pair(family, 1.0, end - 1e-9) is not None
        assert pair(family, 1.0, end + 1e-9) is None
        with pytest.raises(NoStateError, match="a pair has no state"):
            localised(family, numbers(omega=end + 0.5), 30)


@pytest.mark.parametrize(
    ("family", "epsilon", "omega", "stable"),
    [
        (EQUAL, 1.0, -4.0, False),
        (EQUAL, 1.0, -8.0, True),
        (REAL, 1.0, -12.0, False),
        (REAL, 1.0, -13.0, True),
        (ASYMMETRIC, 1.0, -13.0, True),
        (IMAGINARY, 1.0, -13.0, False),
        (EQUAL, 0.05, -5.0, True),
        # A = B on one pair swings at the square 4 gamma (-Omega - gamma), and the lower edge of the
        # band of A - B has Omega^2 - 4 gamma^2: the two are equal at Omega = -4 gamma
        (EQUAL, 0.01, -4.0, False),
    ],
)
def test_verdicts_of_stability_are_the_same_on_twice_the_chain(family, epsilon, omega, stable):
    for half_width in (20, 40):
        breather = localised(family, numbers(epsilon, 1.0, omega), half_width)
        assert bool(exponents(*breather).real.max() <= 0.0) is stable
