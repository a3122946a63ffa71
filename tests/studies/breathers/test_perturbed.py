"""Perturbed breathers in the nonlinear flow: rates against Floquet's, and which breathers stay."""

import numpy as np
import pytest
from on_breathers import ABOVE, BELOW, at_twelve, members
from pendula.studies.breathers.multipliers import growths, half_traces
from pendula.studies.breathers.perturbed import measured_growth, range_of_power, run_from


def fastest(breather, parity):
    traces = half_traces(breather, parity)
    rates = growths(breather.frequency, traces)
    return complex(traces[rates.argmax()]), float(rates.max())


@pytest.mark.parametrize(("constants", "family", "frequency", "parity", "is_quartet"), [
    (BELOW, "A = B", 9.2, "even", False), (ABOVE, "A = B", 9.2, "even", False),
    (ABOVE, "A = -B", 9.2, "even", True), (ABOVE, "A = -B", 8.1, "odd", False),
])  # fmt: skip
def test_a_perturbation_grows_at_the_rate_of_floquet(
    constants, family, frequency, parity, is_quartet
):
    (one,) = members(constants, family, frequency, least=14, most=24)
    trace, rate = fastest(one, parity)
    assert rate > 0.1 and bool(trace.imag) is is_quartet
    assert measured_growth(one, trace, parity) == pytest.approx(rate, rel=1e-3)


def test_a_rate_that_is_not_the_flows_is_noticed():
    """The expected trace sets how long the runs are, and not what they measure."""
    one = at_twelve(BELOW, "A = B", 14)
    trace, rate = fastest(one, "even")
    assert measured_growth(one, 1.0 + 1.2 * (trace - 1.0)) == pytest.approx(rate, rel=2e-3)


@pytest.mark.parametrize("family", ["A only", "A = -B"])
def test_a_stable_breather_keeps_its_range_of_power(family):
    """Its phase drifts in proportion to time, but the change stays as small for 400 periods."""
    one = at_twelve(BELOW, family, 14)
    assert fastest(one, "even")[1] == fastest(one, "odd")[1] == 0.0
    lowest, highest = range_of_power(one, 1e-3, 200.0, 1e-10)
    assert lowest[1] == pytest.approx(lowest[0], rel=1e-3)
    assert highest[1] == pytest.approx(highest[0], rel=1e-3)


def test_an_unstable_breather_leaves_its_range_of_power():
    """P of A = B on the central pair is constant, until the change has grown."""
    lowest, highest = range_of_power(at_twelve(BELOW, "A = B", 14), 1e-3, 200.0, 1e-10)
    assert highest[0] > 1.1 * lowest[0]


def test_data_are_changed_on_the_central_pair_alone():
    one = at_twelve(BELOW, "A only", 14)
    plain, changed = (run_from(one, change, 0.1, 0.1, 1e-12)[..., 0] for change in (0.0, 1e-3))
    centre = plain.shape[1] // 2
    off = np.abs(changed - plain)
    assert off[:, centre] == pytest.approx([1e-3, 0.7e-3] * plain[:, centre], rel=1e-6)
    assert np.delete(off, centre, axis=1).max() == 0.0
