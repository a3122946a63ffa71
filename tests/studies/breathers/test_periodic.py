"""Periodic breathers: periods by an independent solver, multipliers, laws, and what has none."""

import numpy as np
import pytest
from on_breathers import ABOVE, BELOW, at_twelve, members, run_from, unfolded
from pendula.problem import Constants
from pendula.studies.breathers.periodic import (
    FAMILIES,
    least_power,
    power_at,
    shoot,
    single_site,
)
from pendula.studies.breathers.waves import bands, distance_from_bands

M = 20


def after(breather, quarters, change=0.0, steps=1):
    """Return the run over so many quarters of a period, from the breather with its data changed."""
    end = quarters * breather.quarter
    start = unfolded(breather.data + change)
    return run_from(breather.constants, start, end, end / steps)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("constants", [BELOW, ABOVE], ids=["below", "above"])
def test_a_breather_is_periodic_by_the_taylor_method_and_has_its_symmetry(constants, family):
    """P falls from the instant at which all is real to that at which all is imaginary."""
    breather = at_twelve(constants, family, M)
    for quarters, sign in ((2, -1.0), (4, 1.0)):
        assert (
            np.abs(after(breather, quarters).final - sign * unfolded(breather.data)).max() < 1e-11
        )
    power = after(breather, 1, steps=40).l2 ** 2
    assert power[:, 0] == pytest.approx(power_at(breather, "both real"), rel=1e-12)
    assert power[:, -1] == pytest.approx(power_at(breather, "both imaginary"), rel=1e-10)
    assert (np.diff(power.sum(axis=0)) < 1e-11 * power.max()).all()
    a, b = breather.data
    if family == "A only":
        assert 0.0 < np.abs(b).max() < 0.3 * np.abs(a).max()
    else:
        assert np.array_equal(a, b if family == "A = B" else -b)


@pytest.mark.parametrize(("instant", "lowest"), [("both real", 36.29), ("both imaginary", 30.25)])
def test_the_least_p_of_a_family_lies_between_the_frequencies_of_a_grid(instant, lowest):
    least = least_power(members(BELOW, "A only", 8.1, 8.5, 9.0, 10.0), instant)
    assert least == pytest.approx(lowest, abs=5e-3)
    fine = members(BELOW, "A only", *np.arange(8.7, 8.86, 0.01))
    powers = [power_at(one, instant).sum() for one in fine]
    assert least == pytest.approx(min(powers), rel=1e-5) and powers[0] > least < powers[-1]
    assert least < (1.0 + 1e-9) * min(powers)


# --- Where families exist -------------------------------------------------------------------------


@pytest.mark.parametrize(("omega", "expected"), [
    (-4.0, [(4.0, 8.0), (12.0**0.5, 60.0**0.5)]), (8.0, [(4.0, 8.0), (12.0**0.5, 60.0**0.5)]),
    (1.0, [(0.0, 3.0), (0.0, 5.0**0.5)]),
])  # fmt: skip
def test_bands_of_linear_waves(omega, expected):
    found = bands(Constants(epsilon=1.0, gamma=1.0, omega=omega))
    assert np.array(found) == pytest.approx(np.array(expected))


@pytest.mark.parametrize(("frequency", "distance"), [
    (8.5, 0.5), (12.0, 4.0), (5.0, 0.0), (2.0, 0.0), (2.8, 0.4), (1.0, 0.0),
])  # fmt: skip
def test_odd_multiples_may_meet_a_band(frequency, distance):
    """2.8 lies below the band, 8.4 above it; 3 times 2 lies within, as does 5 times 1."""
    assert distance_from_bands(BELOW, frequency) == pytest.approx(distance)


@pytest.mark.parametrize(
    ("constants", "family", "frequencies", "found"),
    [
        (BELOW, "A = -B", [3.0, 12.0], [12.0]),  # 3 lies in a free interval below the waves
        (BELOW, "A only", [5.0, 10.0, 20.0], [20.0, 10.0]),  # 5 lies within them
        (ABOVE, "A only", [8.07, 8.1, 9.0], [9.0, 8.1]),  # then it has become A = B
        (ABOVE, "A = B", [8.07, 8.1, 9.0], [9.0, 8.1, 8.07]),
    ],
)
def test_a_family_is_followed_down_to_where_it_ends(constants, family, frequencies, found):
    followed = members(constants, family, *frequencies, most=40)
    assert [one.frequency for one in followed] == found
    last = followed[-1]
    if last.frequency > 8.1:  # it is the family that starts from the single site
        near = shoot(constants, last.frequency, single_site(constants, last.frequency, family, 40))
        off = np.abs(last.data - near.data[:, : last.data.shape[1]])
        assert off[:, 0].max() < 1e-12
        assert off.max() < 1e-7  # the end of a shorter chain cuts off as much of the tails
