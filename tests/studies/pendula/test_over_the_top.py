"""Passages of pendula over the top, and their power before that."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from on_pendula import pendula
from pendula.studies.pendula.over_the_top import measure_over_the_top, passage
from problems import problem_of


def one_pendulum(angle: float, velocity: float = 0.0, **changes):
    """Return a pair that moves as one, which is a pendulum without a drive; mu = 0.3."""
    start = {0: ((angle - 1j * velocity) / 0.6,) * 2}
    return pendula(half_width=0, epsilon=0.0, mu=0.3, omega=0.0, initial=start, **changes)


@pytest.mark.parametrize(("share", "goes"), [(0.999, False), (1.001, True)])
def test_a_pendulum_goes_over_the_top_with_more_energy_than_there(share, goes):
    """From below with the velocity v it comes to the top if v^2 / 2 > 2."""
    found = passage(one_pendulum(0.0, 2.0 * share, end_time=3.0))
    assert np.isfinite(found["time"]) == goes


def test_power_is_that_of_the_amplitudes_of_a_small_swing():
    found = passage(one_pendulum(0.01, end_time=20.0))
    assert found["site_power"] == pytest.approx(2.0 * (0.01 / 0.6) ** 2, rel=0.01)


def test_small_mu_stays_below_the_top_and_large_mu_goes_over_it():
    fast = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}
    case = problem_of("fig4_small", solver=fast, end_time=6.0)
    data = as_xarray(*measure_over_the_top(case, [0.1, 0.3], 1e-6, 2, 1, 5.0))
    assert np.isinf(data["passage_time"].sel(mu=0.1)).all()
    assert (data["passage_time"].sel(mu=0.3) < 5.0).all()
    assert data["passed"].isel(tau=-1).values.tolist() == [0.0, 1.0]
