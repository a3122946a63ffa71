"""What is kept of long studies for the documents is what they hold, on made-up results."""

import keep
import made_up_unbounded as made_up
import numpy as np
import pytest
import xarray as xr
from latticode.datasets.netcdf import read
from pendula.studies.breathers.fates import FATES
from pendula.studies.unbounded.measured import measure_fronts


def test_the_chain_without_ends_is_reduced_to_its_numbers(tmp_path):
    still, slow = (made_up.spread(power, speed=speed, delay=0.0)
                   for power, speed in ((0.0, 0.5), (0.51, 0.4)))  # fmt: skip
    runs = {
        "thermal": made_up.thermal(),
        "transverse": made_up.transverse(),
        "fig4_small": made_up.spread(0.5),
        "omegas": made_up.spread((0.5, 0.4), variants=2, omegas=(-1.0, 2.0)),
        # where the chain at rest is stable no delay is predicted
        **{name: run.assign(predicted_delay=run["predicted_delay"] * np.nan)
           for name, run in (("fig3_large", slow), ("fig3_small", still), ("fig2_large", still))},
    }  # fmt: skip
    runs["fronts"] = measure_fronts(runs["omegas"], runs["transverse"], runs["thermal"])
    for name, run in runs.items():
        folder = tmp_path / ("unbounded" if name == "thermal" else "long/unbounded")
        folder.mkdir(parents=True, exist_ok=True)
        run.to_netcdf(folder / f"{name}.nc")
    keep.main(tmp_path, tmp_path / "quoted")
    kept = read(tmp_path / "quoted/unbounded.nc")
    assert kept["exponent"].values[:2] == pytest.approx([0.5, 0.51], abs=0.02)
    assert kept["speed"].values[0] == pytest.approx(2.9, abs=0.03)
    assert kept["power"].values[0] == pytest.approx(made_up.POWER, rel=0.02)
    assert kept["omega_exponent"].values == pytest.approx([0.5, 0.4], abs=0.02)
    assert kept["power_between"].values == pytest.approx(made_up.ALONE, rel=0.02)
    assert kept["thermal_power"].values == pytest.approx(made_up.POWER)
    assert kept["second_front_speed"].values == pytest.approx(made_up.SECOND, abs=0.03)


def made_up_fates() -> xr.Dataset:
    """Return fates at two Omega."""
    fate = np.array([[[1, 1, 3], [1, 1, 1], [3, 1, 1]], np.full((3, 3), 3)], np.int8)
    over, turned = ("omega", "a0", "b0"), (("omega", "turned_a0", "phase"), np.ones((2, 1, 2)))
    area = (("plane", "omega", "fate_name"), np.arange(8.0).reshape(1, 2, 4))
    about = dict.fromkeys((*keep.SAME_RUNS, "solver"), "made up") | {"end_time": 70.0}
    return xr.Dataset(
        {"fate": (over, fate, {"flag_meanings": " ".join(FATES)}), "turned_fate": turned,
         **dict.fromkeys(("area", "area_low", "area_high"), area)},
        {"omega": [-4.0, 0.0], "a0": [1.0, 2.0, 3.0], "b0": [1.0, 2.0, 3.0], "turned_a0": [1.0],
         "plane": ["amplitudes"], "fate_name": list(FATES), "phase": [0.0, 1.0]},
        about,
    )  # fmt: skip


def test_the_long_studies_of_breathers_are_reduced_to_shares_and_maps(tmp_path):
    shares = {name: ("size", [1.0, 0.2]) for name in ("share", "share_low", "share_high")}
    spread = xr.Dataset(shares, {"size": [1e-8, 1e-1]}, {"members": 400})
    (tmp_path / "long/breathers").mkdir(parents=True)
    for name, data in (("fates", made_up_fates()), ("sensitivity", spread)):
        for variable in data.variables.values():
            variable.attrs |= {"long_name": "made up", "units": "1"}
        data.to_netcdf(tmp_path / f"long/breathers/{name}.nc")
    keep.main(tmp_path, tmp_path / "quoted")
    kept = read(tmp_path / "quoted/breathers.nc")
    assert kept["fate"].dtype == np.int8 and kept["fate"].shape == (2, 3, 3)
    assert kept["fate"].attrs["flag_meanings"] == " ".join(FATES)
    assert kept["share"].values.tolist() == [1.0, 0.2]
    assert kept["area"].values.ravel().tolist() == list(range(8))
    assert kept.attrs["members"] == 400 and kept.attrs["points"] == 3
