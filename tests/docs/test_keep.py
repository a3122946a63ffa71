"""What is kept of a run for the documents is what the run holds, on made-up results."""

import json

import keep
import made_up_unbounded as made_up
import numpy as np
import pytest
import xarray as xr


def _stable(exponent, speed):
    """Return runs where the chain at rest is stable, so that no delay is predicted."""
    run = made_up.spread(exponent, speed=speed, delay=0.0)
    return run.assign(predicted_delay=run["predicted_delay"] * np.nan)


@pytest.fixture
def results(tmp_path):
    """Return a folder with the results that are reduced, made up."""
    long = tmp_path / "results/unbounded/long"
    long.mkdir(parents=True)
    made_up.thermal().to_netcdf(long.parent / "thermal.nc")
    still = _stable(0.0, 0.5)
    runs = {
        "fig4_small": made_up.spread(0.5),
        "fig3_large": _stable(0.51, 0.4),
        "fig3_small": still,
        "fig2_large": still,
        "omegas": made_up.spread(0.5, variants=2, omegas=(-1.0, 2.0)),
        "amplitudes": made_up.spread((0.0, 0.5), variants=2, amplitudes=(1.0, 5.0)),
        "tolerances": made_up.spread(0.5, variants=2).assign(tolerance=("variant", [1e-6, 1e-8])),
    }
    for name, run in runs.items():
        run.to_netcdf(long / f"{name}.nc")
    return tmp_path / "results"


def test_the_long_study_is_reduced_to_its_numbers(results, tmp_path):
    keep.main(results, tmp_path / "quoted")
    assert [path.name for path in (tmp_path / "quoted").iterdir()] == ["unbounded.nc"]
    with xr.open_dataset(tmp_path / "quoted/unbounded.nc") as kept:
        assert kept["exponent"].values[:2] == pytest.approx([0.5, 0.51], abs=0.02)
        assert kept["growth"].values[2:] == pytest.approx([0.0, 0.0], abs=1e-3)
        assert kept["speed"].values[:2] == pytest.approx([2.9, 0.4], abs=0.03)
        assert kept["omega_speed"].values == pytest.approx(2.9, abs=0.03)
        assert kept["omega_thermal_power"].values == pytest.approx(16.0)
        assert kept["amplitude_factor"].values == pytest.approx([1.0, 20.0**0.5], abs=0.05)
        assert set(kept["law"].values) >= {"constant", "log_tau"}
        assert kept["law_ahead"].sel(law="constant") < kept["law_ahead"].sel(law="log_tau")
        assert kept["tolerance_bulk_power"].values == pytest.approx(16.0, rel=0.2)
        for name, variable in kept.variables.items():
            assert variable.attrs["long_name"] and variable.attrs["units"], name


def test_the_full_run_is_reduced_to_what_is_quoted(tmp_path):
    results = tmp_path / "results"
    (results / "checks").mkdir(parents=True)
    (results / "claims.json").write_text(json.dumps([{"name": "a"}]))
    cases = xr.Dataset({"error": ("row", [1.0])})
    for variable in cases.variables.values():
        variable.attrs = {"long_name": "made up", "units": "1"}
    cases.to_netcdf(results / "checks/hard_cases.nc")
    (results / "speed").mkdir()
    (results / "speed/reproduction.json").write_text("measured")
    keep.main(results, tmp_path / "quoted")
    with xr.open_dataset(tmp_path / "quoted/hard_cases.nc") as kept:
        assert kept["error"].values.tolist() == [1.0]
    assert (tmp_path / "quoted/reproduction.json").read_text() == "measured"
    assert json.loads((tmp_path / "quoted/claims.json").read_text()) == [{"name": "a"}]
