"""What is kept of a run for the documents is what the run holds, on made-up results."""

import json

import keep
import made_up_unbounded as made_up
import numpy as np
import pytest
import xarray as xr
from pendula.studies.breathers.fates import FATES


def _stable(exponent, speed):
    """Return runs where the chain at rest is stable, so that no delay is predicted."""
    run = made_up.spread(exponent, speed=speed, delay=0.0)
    return run.assign(predicted_delay=run["predicted_delay"] * np.nan)


@pytest.fixture
def results(tmp_path):
    """Return a folder with the results that are reduced, made up."""
    long = tmp_path / "results/long/unbounded"
    long.mkdir(parents=True)
    short = tmp_path / "results/unbounded"
    short.mkdir()
    made_up.thermal().to_netcdf(short / "thermal.nc")
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
        assert kept["block_maximum"].values == pytest.approx(kept["block_thermal"].values, rel=0.01)
        assert kept["block_low"] <= 1.0 <= kept["block_high"] < kept["norm_ahead"]
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


@pytest.fixture
def breathers(tmp_path):
    """Return a folder with made-up long studies of fates and of sensitivity."""
    long = tmp_path / "results/long/breathers"
    long.mkdir(parents=True)
    nan, over = np.nan, ("omega", "a0", "b0")
    fate = [[[1, 1, 3], [1, 1, 1], [3, 1, 1]], [[3, 3, 3], [3, 3, 3], [3, 3, 3]]]
    left = [[[0.1, 0.6, nan], [0.6, 0.1, 9.0], [nan, nan, 0.1]], np.full((3, 3), nan)]
    distance = [[[0.0, 0.05, nan], [0.15, 0.0, nan], [nan, nan, 0.0]], np.full((3, 3), nan)]
    area = np.arange(8.0).reshape(1, 2, 4)
    periodic = np.where(np.isnan(left), -1, np.array(left) <= 1.0).astype(np.int8)
    turned = (("omega", "turned_a0", "phase"), np.ones((2, 1, 2), np.int8))
    fates = xr.Dataset(
        {
            "fate": (over, np.array(fate, dtype=np.int8), {"flag_meanings": " ".join(FATES)}),
            "periodic": (over, periodic), "turned_fate": turned, "turned_periodic": turned,
            "unreturned": (over, left), "family_distance": (over, distance),
            "breather_family": (over, (periodic == 1).astype(np.int8)),
            **dict.fromkeys(AREAS, (("plane", "omega", "fate_name"), area)),
            "checked_fate": (("conditions", "omega", "checked"),
                             [[[1, 3], [3, 1]], [[1, 1], [3, 3]]]),
        },
        {"omega": [-4.0, 0.0], "a0": [1.0, 2.0, 3.0], "b0": [1.0, 2.0, 3.0], "turned_a0": [1.0],
         "plane": ["amplitudes"], "fate_name": list(FATES),
         "conditions": ["as on the map", "twice the time"], "phase": [0.0, 1.0]},
        {"epsilon": 1.0, "gamma": 1.0, "half_width": 30, "end_time": 70.0, "ratio": 0.2,
         "boundary": "dirichlet", "solver": "taylor", "solver_rtol": 1e-7},
    )  # fmt: skip
    spread = xr.Dataset(
        {
            **{name: ("size", [1.0, 0.2]) for name in ("share", "share_low", "share_high")},
            "spread": ("initial", [1, 0, 1, 0, 0]),
        },
        {"size": [1e-8, 1e-1], "initial": [3.0, 3.5, 4.0, 4.5, 5.0]},
        {"members": 400},
    )
    for name, data in (("fates", fates), ("sensitivity", spread)):
        for variable in data.variables.values():
            variable.attrs |= {"long_name": "made up", "units": "1"}
        data.to_netcdf(long / f"{name}.nc")
    return tmp_path / "results"


AREAS = ("area", "area_low", "area_high")


def test_the_long_studies_of_breathers_are_reduced_to_shares_and_maps(breathers, tmp_path):
    keep.main(breathers, tmp_path / "quoted")
    with xr.open_dataset(tmp_path / "quoted/breathers.nc") as kept:
        here = kept.sel(omega=-4.0)
        assert float(here["periodic_share"]) == float(here["periodic_if_more"]) == 2 / 4
        assert float(here["periodic_if_less"]) == 0.0
        assert float(here["unknown_share"]) == pytest.approx(1 / 4)
        assert float(here["alone"]) == float(here["compared"]) == 1.0
        assert float(here["near"]) == pytest.approx(1 / 2)
        assert float(here["median_distance"]) == pytest.approx(0.1)
        assert np.isnan(kept["near"].sel(omega=0.0))
        assert here["changed"].values.tolist() == [0.0, 0.5]
        assert here["terms_share"].sel(fate_name="stays").values.tolist() == [0.5, 1.0]
        assert int(kept["stay"]) == 2 and kept["stay_on"].values.tolist() == [2, 1]
        assert kept["fate"].dtype == np.int8 and kept["fate"].shape == (2, 3, 3)
        assert kept["fate"].attrs["flag_meanings"] == " ".join(FATES)
        assert kept["scan_share"].values.tolist() == pytest.approx([1 / 2, 1 / 3])
        assert float(kept["scan_spread"]) == pytest.approx(0.4)
        assert float(kept["largest_that_spreads"]) == 4.0
        assert kept["area"].values.ravel().tolist() == list(range(8))
        assert kept.attrs["members"] == 400 and kept.attrs["points"] == 3
