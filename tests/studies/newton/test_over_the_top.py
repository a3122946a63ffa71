"""Passages of pendula over the top, and their power before that."""

import numpy as np
import pytest
import xarray as xr
from latticode.datasets.netcdf import as_xarray
from on_pendula import pendula
from pendula.studies.newton.over_the_top import (
    measure_amplitude_power,
    measure_over_the_top,
    measure_passage,
    printed_numbers,
)
from problems import problem_of


def one_pendulum(angle: float, velocity: float = 0.0, **changes):
    """Return a pair that moves as one, which is a pendulum without a drive; mu = 0.3."""
    start = {0: ((angle - 1j * velocity) / 0.6,) * 2}
    return pendula(half_width=0, epsilon=0.0, mu=0.3, omega=0.0, initial=start, **changes)


@pytest.mark.parametrize(("share", "goes"), [(0.999, False), (1.001, True)])
def test_a_pendulum_goes_over_the_top_with_more_energy_than_there(share, goes):
    """From below with the velocity v it comes to the top if v^2 / 2 > 2."""
    passage = measure_passage(one_pendulum(0.0, 2.0 * share, end_time=3.0))
    assert np.isfinite(passage["time"]) == goes


def test_power_is_that_of_the_amplitudes_of_a_small_swing():
    passage = measure_passage(one_pendulum(0.01, end_time=20.0))
    assert passage["site_power"] == pytest.approx(2.0 * (0.01 / 0.6) ** 2, rel=0.01)


def test_power_of_the_amplitudes_is_that_of_a_site_on_the_same_chain():
    """On A = B the drive vanishes and P is conserved: 2 * 1.5^2 on three pairs."""
    case = problem_of("fig4_small", half_width=1, initial={0: (1.5, 1.5)}, end_time=4.0)
    assert measure_amplitude_power(case)["site_power"] == pytest.approx(2.0 * 1.5**2 / 3.0)


def test_power_is_compared_only_where_no_pendulum_is_over_the_top():
    """All members at mu = 0.1 have 3 % more than the amplitudes; one at 0.2 goes over the top."""
    study = xr.Dataset(
        {
            "passage_time": (("mu", "member"), [[np.inf, np.inf], [3.0, np.inf]]),
            "site_power": (("mu", "member"), [[20.6, 20.6], [90.0, 20.0]]),
            "amplitude_power": ("member", [20.0, 20.0]),
        },
        {"mu": [0.1, 0.2], "tau": [1.0, 2.0, 4.0]},
    )
    for end in ("", "_low", "_high"):
        passed = (("mu", "tau"), [[0.0, 0.0, 0.0], [0.0, 0.0, 0.5]])
        study = study.assign({f"passed{end}": passed, f"passage_rate{end}": ("mu", [0.0, 0.1])})
    numbers = printed_numbers(study, 2.0)
    np.testing.assert_allclose(numbers["power_excess"].value, [0.03, np.nan])
    np.testing.assert_array_equal(numbers["passed"].value, [0.0, 0.0])


def test_small_mu_stays_below_the_top_and_large_mu_goes_over_it():
    fast = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}
    case = problem_of("fig4_small", solver=fast, end_time=6.0)
    data = as_xarray(*measure_over_the_top(case, [0.1, 0.3], 1e-6, 2, 1, 5.0).make())
    assert np.isinf(data["passage_time"].sel(mu=0.1)).all()
    assert (data["passage_time"].sel(mu=0.3) < 5.0).all()
    assert data["passed"].isel(tau=-1).values.tolist() == [0.0, 1.0]
