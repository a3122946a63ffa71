"""What is measured of runs: speeds of made-up fronts, the law of l2^2, and the accepted results."""

import numpy as np
import pytest
import xarray as xr
from made_up_unbounded import ALONE, OMEGAS, POWER, SECOND, exact, spread, thermal, transverse
from pendula.studies.unbounded.measured import (
    measure_fronts,
    measure_growth,
    resolution,
    speeds,
)

TAU = np.arange(2.0, 202.0, 2.0)


def front_of(way, tau=TAU, rest=0.0):
    """Return a run of the shape that `speeds` reads, with the places `way` of its front."""
    front = (("variant", "member", "piece_tau"), way[None, None])
    predicted = {"predicted_delay": ("variant", [1.4]), "predicted_rest": ("variant", [rest])}
    return xr.Dataset({"front": front} | predicted, {"piece_tau": tau})


def test_the_speed_of_a_made_up_front():
    run = front_of(2.5 * TAU - 1.4 * np.log(TAU) - 3.0 / np.sqrt(TAU), rest=3.0)
    plain, error = speeds(run)
    assert plain[0] < 2.495 and speeds(run, corrected=True)[0] == pytest.approx(2.5, abs=1e-9)
    assert error[0] == resolution(TAU) == pytest.approx(1.5 / 133.3, rel=1e-3)


def test_the_law_has_no_fitted_constant_and_the_offset_is_found():
    one = measure_growth({"fig4_small": exact()}, thermal(), transverse()).isel(case=0)
    left = one["l2_rate"].sel(band="mean") - one["law_rate"]
    np.testing.assert_allclose(left, one["offset_rate"], rtol=1e-6)
    np.testing.assert_allclose(one["offset_rate"] * one["span_tau"], -50.0, rtol=0.02)


@pytest.mark.parametrize("name", ["epsilon", "gamma"])
def test_a_run_of_other_constants_than_the_thermal_states_has_no_law(name):
    other = thermal().assign_attrs({name: 2.0})
    growth = measure_growth({"fig4_small": spread()}, other, transverse())
    assert all(growth[law].isnull().all() for law in ("law_rate", "thermal_linf"))


def test_both_fronts_and_the_powers_behind_them_are_those_of_the_made_up_runs():
    run = spread(variants=4, omegas=OMEGAS, members=3)
    found = measure_fronts(run, transverse(), thermal())
    np.testing.assert_allclose(found["second_front_speed"], SECOND, atol=0.02)
    np.testing.assert_allclose(found["front_speed"], 2.9, atol=0.03)  # its delay is not added back
    np.testing.assert_allclose(found["power_behind"], POWER, rtol=0.01)
    np.testing.assert_allclose(found["power_between"], ALONE, rtol=0.01)
    assert found["shown_omega"] == 5.0
    # |S|^2 is one behind the second front, 180 sites behind the first, and nothing before it
    behind = found["symmetric_power_behind_front"].isel(omega=0)
    end = int(run["front"][0, 0, -1]) - int(run["second_front"][0, 0, -1])
    assert (behind.where(behind["distance"] < end - 20, 0.0) < 1e-9).all()
    assert (behind.where(behind["distance"] > end + 20, 1.0) == 1.0).all()
