"""Perturbed breathers in the nonlinear flow: rates against Floquet's, and which breathers stay."""

import numpy as np
import pytest
from pendula.problem import Constants
from pendula.studies.breathers.multipliers import growths, half_traces
from pendula.studies.breathers.periodic import family_of
from pendula.studies.breathers.perturbed import measured_growth, range_of_power, run_from

BELOW = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
ABOVE = Constants(epsilon=1.0, gamma=1.0, omega=8.0)


def breather(constants, family, frequency):
    (found,) = family_of(constants, family, [frequency], {"least": 14, "most": 24})
    return found


def fastest(one, parity="even"):
    traces = half_traces(one, parity)
    rates = growths(one.frequency, traces)
    return complex(traces[rates.argmax()]), float(rates.max())


@pytest.mark.parametrize(("constants", "family", "is_quartet"), [
    (BELOW, "A = B", False), (ABOVE, "A = B", False), (ABOVE, "A = -B", True),
])  # fmt: skip
def test_a_perturbation_grows_at_the_rate_of_floquet(constants, family, is_quartet):
    one = breather(constants, family, 9.2)
    trace, rate = fastest(one)
    assert bool(trace.imag) is is_quartet
    assert measured_growth(one, trace) == pytest.approx(rate, rel=1e-3)


def test_an_odd_perturbation_grows_at_the_rate_of_floquet():
    one = breather(ABOVE, "A = -B", 8.1)
    trace, rate = fastest(one, "odd")
    assert rate > 0.1
    assert measured_growth(one, trace, "odd") == pytest.approx(rate, rel=1e-3)


def test_a_rate_that_is_not_the_flows_is_noticed():
    """The expected trace sets how long the runs are, and not what they measure."""
    one = breather(BELOW, "A = B", 12.0)
    trace, rate = fastest(one)
    assert measured_growth(one, 1.0 + 1.2 * (trace - 1.0)) == pytest.approx(rate, rel=2e-3)


def test_a_stable_breather_swings_as_before_and_an_unstable_one_does_not():
    lowest, highest = range_of_power(breather(BELOW, "A only", 12.0), 1e-3, 200.0, 1e-10)
    assert lowest[1] == pytest.approx(lowest[0], rel=1e-3)
    assert highest[1] == pytest.approx(highest[0], rel=1e-3)
    # P of A = B on the central pair is constant, until the change has grown
    lowest, highest = range_of_power(breather(BELOW, "A = B", 12.0), 1e-3, 200.0, 1e-10)
    assert highest[0] > 1.1 * lowest[0]


def test_data_are_changed_on_the_central_pair_alone():
    one = breather(BELOW, "A only", 12.0)
    plain, changed = (run_from(one, change, 0.1, 0.1, 1e-12)[..., 0] for change in (0.0, 1e-3))
    centre = plain.shape[1] // 2
    off = np.abs(changed - plain)
    assert off[:, centre] == pytest.approx([1e-3, 0.7e-3] * plain[:, centre], rel=1e-6)
    assert np.delete(off, centre, axis=1).max() == 0.0
