"""The speed of a made-up front, and the slope of a made-up law; members of an ensemble."""

import numpy as np
import pytest
import xarray as xr
from latticode.datasets.netcdf import as_xarray
from pendula.studies.unbounded.long_runs import member, run_variables
from pendula.studies.unbounded.measured import resolution, slope_ratios, speeds
from problems import problem_of

TAU = np.arange(2.0, 202.0, 2.0)
DOP = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
PROBLEM = problem_of("fig4_small", half_width=None, end_time=200.0, output_step=2.0, solver=DOP)


def made_up(second, both, alone):
    """Return an ensemble whose second front moves at a speed, with powers behind both fronts."""
    shape = (1, 2, TAU.size)
    series = {name: np.ones(shape) * TAU for name in ("tau", "piece_tau")}
    means = np.broadcast_to([[both, 0.5 * both], [alone, 0.0]], (*shape, 2, 2))
    series |= {"second_front": second * series["tau"], "means": means}
    series |= {name: np.ones(shape) for name in ("front", "l2", "linf")}
    run = as_xarray(run_variables([PROBLEM], series), {})
    speed, delay = (float(run[f"predicted_{name}"][0]) for name in ("speed", "delay"))
    way = speed * TAU - delay * np.log(TAU)
    squares = 2.0 * (second * both * TAU + (way - second * TAU) * alone) + 30.0
    return run.assign(front=run["front"] * way, l2=run["l2"] * np.sqrt(squares))


def test_the_speed_of_a_made_up_front_and_the_slope_of_a_made_up_law():
    run = made_up(1.5, 18.0, 19.0)
    speed, error = speeds(run)
    assert speed == pytest.approx(run["predicted_speed"].values, rel=1e-12)
    assert error[0] == resolution(TAU) == pytest.approx(1.5 / 133.3, rel=1e-3)
    for alone in (19.0, 38.0):
        difference = speed[0] - 1.5
        slope = (1.5 * 18.0 + difference * 19.0) / (1.5 * 18.0 + difference * alone)
        powers = {"power": ("omega", [18.0]), "antisymmetric_power": ("omega", [alone])}
        thermal = xr.Dataset(powers, {"omega": [0.0]})
        (ratio,) = slope_ratios(run, thermal)
        assert ratio.value == pytest.approx(slope, abs=2e-3)


def test_members_differ_by_little_and_are_the_same_every_time():
    drawn = ((1e-6, 2017, 1), (1e-6, 2017, 1), (1e-6, 2017, 2), (1e-6, 1, 1), (1e-3, 2017, 1))
    first, first_again, second, other_seed, larger = (
        member(PROBLEM, *arguments).initial for arguments in drawn
    )
    assert member(PROBLEM, 1e-6, 2017, 0) is PROBLEM
    np.testing.assert_array_equal(first, first_again)
    assert (first != second).all() and (other_seed != first).all()
    np.testing.assert_allclose(larger - PROBLEM.initial, 1e3 * (first - PROBLEM.initial), rtol=1e-8)
    assert first[0, 0] == pytest.approx(1.0, rel=1e-5)
