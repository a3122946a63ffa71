"""What is measured of runs: speeds of made-up fronts, the law of l2^2, and the accepted results."""

import numpy as np
import pytest
import xarray as xr
from accepted import dataset
from made_up_unbounded import POWER, exact, spread, thermal
from pendula.studies.unbounded.measured import measure, measure_growth, resolution, speeds

TAU = np.arange(2.0, 202.0, 2.0)


def front_of(way, tau=TAU, rest=0.0):
    """Return a run of the shape that `speeds` reads, with the places `way` of its front."""
    front = (("variant", "member", "piece_tau", "front_power"), way[None, None, :, None])
    predicted = {"predicted_delay": ("variant", [1.4]), "predicted_rest": ("variant", [rest])}
    return xr.Dataset({"front": front} | predicted, {"piece_tau": tau, "front_power": [1e-2]})


def test_the_speed_of_a_made_up_front():
    run = front_of(2.5 * TAU - 1.4 * np.log(TAU) - 3.0 / np.sqrt(TAU), rest=3.0)
    plain, error = speeds(run)
    assert plain[0] < 2.495 and speeds(run, corrected=True)[0] == pytest.approx(2.5, abs=1e-9)
    assert error[0] == resolution(TAU) == pytest.approx(1.5 / 133.3, rel=1e-3)


def test_no_half_site_to_and_fro_moves_a_speed_by_more_than_the_resolution():
    """The worst case is a front half a site behind at first, and half a site ahead later."""
    middle = 0.5 * (TAU[-1] + TAU[-1] / 3.0)
    worst = front_of(2.5 * TAU + 0.5 * np.sign(TAU - middle))
    assert 0.95 * resolution(TAU) < abs(speeds(worst)[0][0] - 2.5) < 1.02 * resolution(TAU)
    rng = np.random.default_rng(3)
    for _ in range(50):
        noisy = front_of(2.5 * TAU + rng.uniform(-0.5, 0.5, TAU.size))
        assert abs(speeds(noisy)[0][0] - 2.5) < resolution(TAU)


def test_the_first_third_of_a_run_is_left_out_of_its_speed():
    """Of a run to 300 the part from 100 on counts, with 100 itself."""
    tau = np.arange(1.0, 301.0)
    late, later = (front_of(np.where(tau < first, 0.0, 2.5 * tau), tau) for first in (100, 101))
    assert speeds(late)[0][0] == pytest.approx(2.5, abs=1e-12)
    assert abs(speeds(later)[0][0] - 2.5) > 0.01


def test_the_limits_of_a_speed_are_those_of_its_mean_over_members():
    """Student's t of two members, 12.706, times half of their difference."""
    both = xr.concat([front_of(2.0 * TAU), front_of(3.0 * TAU)], "member", data_vars=["front"])
    speed, limits = speeds(both)
    assert (speed[0], limits[0]) == pytest.approx((2.5, 12.7062 * 0.5), rel=1e-5)


def test_the_law_has_no_fitted_constant_and_the_offset_is_found():
    one = measure_growth({"fig4_small": exact()}, thermal()).isel(case=0)
    assert one["law"] == pytest.approx(2.0 * 2.9 * POWER)
    left = one["l2_rate"].sel(band="mean") - one["law_rate"]
    np.testing.assert_allclose(left, one["offset_rate"], rtol=1e-6)
    np.testing.assert_allclose(one["offset_rate"] * one["span_tau"], -50.0, rtol=0.02)


@pytest.mark.parametrize("name", ["epsilon", "gamma"])
def test_a_run_of_other_constants_than_the_thermal_states_has_no_law(name):
    growth = measure_growth({"fig4_small": spread()}, thermal().assign_attrs({name: 2.0}))
    assert all(growth[law].isnull().all() for law in ("law", "law_rate", "thermal_linf"))


GROWN = ("fig4_small", "fig3_large", "fig2_large", "fig3_small")


def test_the_accepted_runs_give_the_accepted_growth_and_front():
    runs = {name: dataset(f"unbounded/{name}") for name in (*GROWN, "omegas", "thermal")}
    of_front = (runs[name] for name in ("omegas", "fig4_small", "fig3_large", "thermal"))
    made = measure({name: runs[name] for name in GROWN}, *of_front)
    for name, found in zip(("growth", "front"), made, strict=True):
        accepted = dataset(f"unbounded/{name}")
        assert found.variables.keys() == accepted.variables.keys()
        for key, values in accepted.variables.items():
            if values.dtype.kind == "U":
                assert found[key].values.tolist() == values.values.tolist(), key
                continue
            near = 2e-5 * float(np.abs(values).max())  # of the single precision of what is kept
            np.testing.assert_allclose(found[key], values, rtol=1e-4, atol=near, err_msg=key)
