"""Floquet multipliers: against the nonlinear flow, on a chain at rest, and growth."""

import numpy as np
import pytest
from on_breathers import ABOVE, BELOW, run_from, unfolded
from pendula.problem import Constants
from pendula.studies.breathers import multipliers
from pendula.studies.breathers.periodic import FAMILIES, find_breather, shoot, single_site


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("parity", multipliers.PARITIES)
def test_multipliers_are_those_of_the_nonlinear_flow(family, parity):
    """By differences of runs over a whole period; those over half a period have their squares."""
    constants, m = Constants(epsilon=0.3, gamma=1.0, omega=8.0), 9
    breather = shoot(constants, 10.0, single_site(constants, 10.0, family, m))
    period, first = 4.0 * breather.quarter, int(parity == "odd")
    sign = (-1.0) ** first
    columns = []
    for re_or_im, row, site in np.ndindex(2, 2, m + 1 - first):
        change = np.zeros((2, 2 * m + 1), complex)
        change[row, m + first + site] = 1e-6 * (1.0, 1j)[re_or_im]
        change[row, m - first - site] = sign * change[row, m + first + site]
        ends = [
            run_from(constants, unfolded(breather.data) + sign * change, period, period).final
            for sign in (1.0, -1.0)
        ]
        moved = (ends[0] - ends[1])[:, m + first :] / 2e-6
        columns.append([moved.real, moved.imag])
    values = np.linalg.eigvals(np.reshape(columns, (len(columns), -1)).T)
    nu = multipliers.half_traces(breather, parity)
    assert 2 * len(nu) == len(values)
    for mu in (nu + np.sqrt(nu**2 - 1.0))[nu != 1.0]:
        assert np.abs(values - mu**2).min() < 1e-6 * abs(mu**2)
    shift = np.abs(values - 1.0).min()  # along the solution, with a Jordan block
    assert bool(shift < 1e-3) is (parity == "even")


@pytest.mark.parametrize(
    ("nu", "rate"),
    [
        ([0.3, -1.0, 1.0, 1.0 + 1e-13, 0.5 + 1e-9j], 0.0),  # on the circle, but for rounding
        ([-np.cosh(0.2)], 0.4 / np.pi),  # mu = -e^x over half a period pi / 2
        ([np.cosh(0.2 + 0.7j)], 0.4 / np.pi),  # a quartet e^(x + i y)
    ],
)
def test_growth_of_traces(nu, rate):
    assert multipliers.growth_rate_of_traces(2.0, np.array(nu)) == pytest.approx(rate)


@pytest.mark.parametrize(
    ("constants", "family", "frequency", "stable"),
    [
        (BELOW, "A only", 9.0, True),
        (BELOW, "A = B", 9.0, False),
        (ABOVE, "A = -B", 9.0, False),  # a quartet
        (ABOVE, "A = -B", 12.0, True),
    ],
)
def test_a_breather_has_one_verdict_on_two_chains(constants, family, frequency, stable):
    for half_width in (20, 40):
        breather = find_breather(family, constants, frequency, half_width)
        assert (multipliers.growth_rate(breather) == 0.0) is stable
