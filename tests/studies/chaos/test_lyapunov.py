"""Lyapunov exponents: what any Hamiltonian flow promises, and means over members."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from latticode.localised.tangents import grow, random_tangent
from latticode.measures.growth import mean_rate
from pendula.studies.chaos import lyapunov
from problems import problem_of

SEED = 20170817


def test_the_spectrum_is_that_of_a_hamiltonian_flow():
    """Exponents sum to zero at every time, come in pairs of opposite sign, and two vanish."""
    problem, rng = problem_of("fig3_large", half_width=1), np.random.default_rng(SEED)
    growth = grow(problem, np.array([random_tangent(3, rng) for _ in range(12)]), 200.0)
    np.testing.assert_allclose(growth.log_growth.sum(axis=0), 0.0, atol=1e-5)
    rates = mean_rate(growth.tau, growth.log_growth, 50.0)
    np.testing.assert_allclose(rates, -rates[::-1], atol=0.05)
    exponents, errors = lyapunov.measure_spectrum(problem, 200.0, SEED)
    assert (errors > 0).all() and exponents[5] < 0.05
    np.testing.assert_allclose(exponents, rates, atol=0.3)


def test_an_exponent_and_its_limits_are_those_of_the_members():
    changes = {"half_width": 15, "solver": {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}}
    cases = {name: problem_of(name, **changes) for name in ("fig4_small", "fig3_small")}
    exponents = as_xarray(*lyapunov.largest_exponents(cases, (5.0, 40.0), 3, 1e-7, SEED))
    assert exponents["chaotic"].values.tolist() == [1, 0]
    runs = lyapunov.follow_members(cases["fig4_small"], 40.0, 3, 1e-7, SEED)
    rates = np.array([(run.log_growth[0, 40] - run.log_growth[0, 5]) / 35.0 for run in runs])
    assert len(set(rates)) == 3
    exponent = exponents.sel(case="fig4_small")
    assert float(exponent["exponent"]) == pytest.approx(rates.mean())
    off = 4.30265 * rates.std(ddof=1) / np.sqrt(3.0)  # Student's t of two degrees of freedom
    assert float(exponent["exponent_high"] - exponent["exponent"]) == pytest.approx(off, rel=1e-4)
