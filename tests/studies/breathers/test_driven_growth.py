"""The law of weak drives against runs, and where it ends."""

import numpy as np
import pytest
from on_breathers import BELOW as FREE
from pendula.problem import Constants
from pendula.studies.breathers import driven_growth


@pytest.fixture(scope="module")
def family():
    return driven_growth.free_breathers(FREE, [*np.arange(5.0, 7.95, 0.1), 8.0], 20)


def test_free_breathers_have_no_b_and_more_power_at_higher_frequency(family):
    powers = [one.power for one in family]
    assert np.all(np.diff(powers) > 0.0)
    # far from the neighbours |a_0|^2 / 2 = lambda - Omega + 2 epsilon
    assert family[-1].profile[0] ** 2 == pytest.approx(2.0 * (family[-1].frequency + 6.0), rel=0.02)


def test_the_image_is_a_wave_within_the_band_alone(family):
    k = 2.0 * np.arcsin(np.sqrt(1.3 / 4.0))
    assert driven_growth.wave(FREE, 5.3) == pytest.approx((np.cos(k), np.sin(k)))
    assert driven_growth.wave(FREE, 4.0) is driven_growth.wave(FREE, 8.0) is None
    assert (
        driven_growth.rate(FREE, family[-1]) == driven_growth.own_radiation(FREE, family[-1]) == 0.0
    )


def test_the_source_is_a_cosine_sum(family):
    one = family[7]
    k = 2.0 * np.arcsin(np.sqrt((one.frequency - 4.0) / 4.0))
    n = np.arange(one.profile.size)
    source = 2.0 * np.sum(one.profile * np.cos(k * n)) - one.profile[0]
    assert driven_growth.rate(FREE, one) == pytest.approx(source**2 / np.sin(k), rel=1e-12)
    assert 0.0 < driven_growth.own_radiation(FREE, one) < 0.01 * driven_growth.rate(FREE, one)


def test_the_rates_of_one_site_are_those_of_the_closed_forms(family):
    """A profile on one site radiates gamma^2 a^2 / (epsilon sin k).

    Its own image has gamma a / (a^2 - 2 i epsilon sin k) there and all along the outgoing waves.
    """
    one = family[10]._replace(profile=np.append(2.0, np.zeros(20)))
    strong = Constants(epsilon=1.0, gamma=0.3, omega=-4.0)
    _, sine = driven_growth.wave(FREE, one.frequency)
    assert driven_growth.rate(strong, one) == pytest.approx(0.09 * 4.0 / sine)
    image = 0.3 * 2.0 / (4.0 - 2.0j * sine)
    assert driven_growth.own_radiation(strong, one) == pytest.approx(4.0 * sine * abs(image) ** 2)


def test_a_weak_drive_feeds_by_the_law(family):
    """The error falls with gamma: the law is of first order."""
    off = []
    for gamma in (0.2, 0.1):
        driven = Constants(epsilon=1.0, gamma=gamma, omega=-4.0)
        times = np.linspace(0.0, 0.16 / gamma**2, 41)
        law = driven_growth.predicted(driven, family, 0, times)
        run = driven_growth.gained(driven, family[0], 80, times, 1e-10)
        off.append(np.abs(run - (law - law[0])).max() / (law[-1] - law[0]))
    assert off[1] < 0.04
    assert off[1] < 0.75 * off[0]


@pytest.mark.parametrize("frequencies", [(5.0, 5.7, 6.5, 7.9), (5.0, 6.0, 7.0, 8.0, 9.0)])
def test_the_law_ends_at_the_edge_of_the_band(frequencies):
    """P of the breather at lambda = 8 ends it, whatever the frequencies at which it is summed."""
    found, _ = driven_growth.growth_contents(
        1.0, -4.0, {1.0: 2.0}, frequencies, 5.0, {"profile": 20, "chain": 30}, 4, 1e-6
    )
    law = found["predicted_gain"].values[0]
    first, last = (driven_growth.free_breathers(FREE, [at], 20)[0].power for at in (5.0, 8.0))
    assert 0.0 == law[0] < law[1] <= law[-1] == pytest.approx(last - first, rel=1e-8)
    assert last - first == pytest.approx(5.998, abs=5e-4)
