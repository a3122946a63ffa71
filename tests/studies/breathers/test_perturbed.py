"""Perturbed breathers in the nonlinear flow: their rates against Floquet's."""

import pytest
from on_breathers import ABOVE, BELOW, at_twelve, half_traces, members
from pendula.studies.breathers.multipliers import growths
from pendula.studies.breathers.perturbed import measured_growth


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


def test_the_expected_rate_sets_the_length_of_the_runs_and_not_what_they_measure():
    one = at_twelve(BELOW, "A = B", 14)
    trace, rate = fastest(one, "even")
    wrong = 1.0 + 1.2 * (trace - 1.0)
    assert measured_growth(one, wrong, "even") == pytest.approx(rate, rel=2e-3)
