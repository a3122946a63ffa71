"""What plays in the report: moduli and angles as bytes, which the page's script reads."""

import base64

import numpy as np
import pytest
import xarray as xr
from accepted import Report
from pendula.studies.paper import motion
from pendula.studies.pendula import phases_section

RUN = "trajectories/fig4_small"


def moving_chain() -> xr.Dataset:
    modulus = np.zeros((2, 3, 4))
    modulus[0, 1] = [1.0, 2.0, 2.0, 2.0]
    modulus[1, 2, 2:] = 1.5
    return xr.Dataset(
        {
            "modulus": (("component", "site", "snapshot"), modulus),
            "snapshot_tau": ("snapshot", [0.0, 0.5, 1.0, 1.5]),
        },
        coords={"component": ["A", "B"], "site": [-1, 0, 1]},
        attrs={"omega": 0.0, "initial": '{"0": [1.0, 0.1]}'},
    )


def test_the_run_to_play_is_quantised_time_after_time():
    shown = motion.played(Report({RUN: moving_chain()}), RUN)
    frames = np.frombuffer(base64.b64decode(shown["frames"]), np.uint8).reshape(4, 2, 3)
    assert shown["count"] == 4 and shown["step"] == 0.5 and str(shown["peak"]) == "2"
    assert frames[:, 0, 1].tolist() == [128, 255, 255, 255]
    assert frames[2:, 1, 2].tolist() == [191, 191]
    assert shown["half"] and shown["still"] == 2  # two of three sites move
    assert str(shown["still_tau"]) == "1"
    assert shown["bars"][0] == [0.0, 1.0, 0.0]


def test_a_chain_of_which_half_never_moves_shows_its_end():
    still = moving_chain().isel(component=[0])
    shown = motion.played(Report({RUN: still}), RUN)
    assert not shown["half"] and shown["still"] == 3


def test_a_film_is_a_byte_for_each_angle():
    results = Report()
    film, data = phases_section.film(results), results["pendula/film"]
    assert film["count"] == data.sizes["picture"] and film["sites"] == data.sizes["site"]
    for player, case in zip(film["players"], data["case"].values, strict=True):
        steps = np.frombuffer(base64.b64decode(player["frames"]), np.int8)
        assert (steps == data["angle_step"].sel(case=case).values.ravel()).all()
        hanging = player["rows"][0][2]
        angle = np.pi / 127 * float(data["angle_step"].sel(case=case)[-1, 0, 2])
        assert hanging["x"] - hanging["from"] == pytest.approx(48.0 * np.sin(angle), abs=0.06)
        assert hanging["y"] - hanging["hook"] == pytest.approx(48.0 * np.cos(angle), abs=0.06)
        per_period = player["step"] * film["per_period"]
        assert per_period == pytest.approx(float(data["tau_of_period"].sel(case=case)))
