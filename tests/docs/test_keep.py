"""What is kept of long studies for the documents is what they hold, on made-up results."""

import keep
import made_up_unbounded as made_up
import numpy as np
import pytest
from latticode.datasets.netcdf import read
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
