"""The speed of a made-up front; test_made_again.py asks for all that is measured of runs."""

import numpy as np
import pytest
import xarray as xr
from pendula.studies.unbounded.measured import resolution, speeds

TAU = np.arange(2.0, 202.0, 2.0)


def test_the_speed_of_a_made_up_front():
    way = 2.5 * TAU - 1.4 * np.log(TAU) - 3.0 / np.sqrt(TAU)
    predicted = {"predicted_delay": ("variant", [1.4]), "predicted_rest": ("variant", [3.0])}
    front = {"front": (("variant", "member", "piece_tau"), way[None, None])}
    run = xr.Dataset(front | predicted, {"piece_tau": TAU})
    plain, error = speeds(run)
    assert plain[0] < 2.495 and speeds(run, corrected=True)[0] == pytest.approx(2.5, abs=1e-9)
    assert error[0] == resolution(TAU) == pytest.approx(1.5 / 133.3, rel=1e-3)
