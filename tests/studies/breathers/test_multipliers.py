"""Floquet multipliers: against the flow over a whole period, on a chain at rest, and growth."""

import numpy as np
import pytest
from on_breathers import ABOVE, BELOW, at_twelve, members
from pendula.numerics.elementary import cos
from pendula.studies.breathers import multipliers
from pendula.studies.breathers.periodic import FAMILIES, Breather, on_half, real_data
from pendula.studies.breathers.quarter_period import flow
from pendula.studies.breathers.waves import bands

ALL = [(constants, family) for constants in (BELOW, ABOVE) for family in FAMILIES]


def monodromy(breather: Breather, parity: str) -> np.ndarray:
    """Return the map of all perturbations over a whole period.

    Rows and columns are the real parts of A and B on all sites, then the imaginary ones.
    """
    sites, first = breather.data.shape[1], multipliers.PARITIES.index(parity)
    units = np.eye(2 * sites).reshape(2, sites, 2, sites)[:, first:].reshape(-1, 2, sites)
    directions = np.zeros((2, len(units), 4, sites))
    directions[0][:, ::2] = directions[1][:, 1::2] = units
    directions, nothing = directions.reshape(-1, 4, sites), np.empty((0, 4, sites))
    bundle = (nothing, directions) if first else (directions, nothing)
    period = 4.0 * breather.quarter
    ends = flow(breather.constants, real_data(breather.data), *bundle, period, 128)[1:, :, first:]
    rows = np.concatenate([ends[:, ::2], ends[:, 1::2]], axis=1).reshape(len(ends), -1)
    return rows.T


@pytest.mark.parametrize("parity", multipliers.PARITIES)
def test_squares_of_multipliers_over_half_a_period_are_those_of_the_flow_over_a_whole_one(parity):
    for breather in (at_twelve(*one, 12) for one in ALL):
        values = np.linalg.eigvals(monodromy(breather, parity))
        nu = multipliers.traces(breather, parity)
        found = nu + np.sqrt(nu**2 - 1.0)
        assert 2 * len(nu) == len(values)
        for mu in found[nu != 1.0]:
            assert np.abs(values - mu**2).min() < 1e-6 * abs(mu**2)
        shift = np.abs(values - 1.0).min()  # along the solution, with a Jordan block
        assert bool(shift < 1e-4) is (parity == "even")


@pytest.mark.parametrize("constants", [BELOW, ABOVE])
def test_on_a_chain_at_rest_traces_fill_the_bands_of_linear_waves(constants):
    """A wave exp(-i omega tau) has nu = -cos(pi omega / lambda)."""
    rest = Breather(constants, 12.0, np.zeros((2, 30)))
    nu = multipliers.traces(rest, "odd")
    ends = [-cos(np.pi * np.array(band) / 12.0) for band in bands(constants)]
    assert np.abs(nu.imag).max() < 1e-6 and multipliers.growth(rest) == 0.0
    assert nu.real.min() == pytest.approx(np.min(ends), abs=0.01)
    assert nu.real.max() == pytest.approx(np.max(ends), abs=0.01)


@pytest.mark.parametrize(("nu", "rate"), [
    ([0.3, -1.0, 1.0, 1.0 + 1e-13, 0.5 + 1e-9j], 0.0),  # on the circle, but for rounding
    ([-np.cosh(0.2)], 0.4 / np.pi),  # mu = -e^x over half a period pi / 2
    ([np.cosh(0.2 + 0.7j)], 0.4 / np.pi),  # a quartet e^(x + i y)
])  # fmt: skip
def test_growth_of_traces(nu, rate):
    assert multipliers.growth_of_traces(2.0, np.array(nu)) == pytest.approx(rate)


@pytest.mark.parametrize(
    ("constants", "family", "frequency", "stable"),
    [
        (BELOW, "A only", 9.0, True),
        (BELOW, "A = B", 9.0, False),
        (ABOVE, "A = -B", 9.0, False),  # a quartet
        (ABOVE, "A = -B", 12.0, True),
        # A = B gives birth to A alone between these two: an even perturbation makes them differ
        (ABOVE, "A = B", 8.08, True),
        (ABOVE, "A = B", 8.083, False),
    ],
)
def test_a_breather_has_one_verdict_on_its_chain_and_on_half_of_it(
    constants, family, frequency, stable
):
    one = members(constants, family, 12.0, frequency)[-1]
    assert (multipliers.growth(one) == 0.0) is stable
    if frequency > 8.1:
        assert (multipliers.growth(on_half(one)) == 0.0) is stable
