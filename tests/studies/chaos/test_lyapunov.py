"""Lyapunov exponents: what any Hamiltonian flow promises, and means over members."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from latticode.measures.growth import mean_rate, mean_rate_error
from pendula.studies.chaos import lyapunov
from problems import problem_of

SEED = 20170817


@pytest.fixture(scope="module")
def whole_spectrum():
    return lyapunov.follow_many(problem_of("fig3_large", half_width=1), 12, 200.0, SEED)


def test_the_spectrum_is_that_of_a_hamiltonian_flow(whole_spectrum):
    """Exponents sum to zero at every time, come in pairs of opposite sign, and two vanish."""
    np.testing.assert_allclose(whole_spectrum.log_growth.sum(axis=0), 0.0, atol=1e-5)
    rates = mean_rate(whole_spectrum.tau, whole_spectrum.log_growth, 50.0)
    assert rates[0] > 0.3
    np.testing.assert_allclose(rates, -rates[::-1], atol=0.05)
    np.testing.assert_allclose(rates[5:7], 0.0, atol=0.05)


@pytest.fixture(scope="module")
def short_cases():
    """Return the growth along three members of a chaotic and of a regular case, on short chains."""
    changes = {"half_width": 15, "solver": {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}}
    cases = {name: problem_of(name, **changes) for name in ("fig4_small", "fig3_small")}
    return cases, as_xarray(
        *lyapunov.largest_exponents(cases, [(5.0, 20.0), (20.0, 60.0)], 3, 1e-7, SEED)
    )


def test_an_exponent_and_its_limits_are_those_of_the_members_on_its_span(short_cases):
    cases, found = short_cases
    runs = lyapunov.follow_members(cases["fig4_small"], 60.0, 3, 1e-7, SEED)
    growths = np.array([run.log_growth[0] for run in runs])
    np.testing.assert_array_equal(growths, found["log_growth"].sel(case="fig4_small"))
    assert found["tau"].values.tolist() == list(range(61))
    rates = (growths[:, 20] - growths[:, 5]) / 15.0
    assert len(set(rates)) == 3
    one = found.sel(case="fig4_small", span="[5, 20]")
    assert float(one["exponent"]) == pytest.approx(rates.mean())
    off = 4.30265 * rates.std(ddof=1) / np.sqrt(3.0)  # Student's t of two degrees of freedom
    assert float(one["exponent_high"] - one["exponent"]) == pytest.approx(off, rel=1e-4)


def test_the_limits_of_a_spectrum_are_those_of_eight_parts_of_the_time(whole_spectrum):
    found = lyapunov.spectrum_of(whole_spectrum, 50.0)
    tau, growth = whole_spectrum.tau, whole_spectrum.log_growth
    np.testing.assert_array_equal(found.value, mean_rate(tau, growth, 50.0))
    off = 2.36462 * mean_rate_error(tau, growth, 50.0)  # Student's t of seven degrees of freedom
    np.testing.assert_allclose([found.value - found.low, found.high - found.value], [off, off])
