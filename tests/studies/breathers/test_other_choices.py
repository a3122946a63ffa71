"""Numbers of breathers and fates that are measured again with other choices."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from pendula.studies.breathers.fates import FATES, MAJORITY, map_fates
from pendula.studies.breathers.other_choices import vary_areas, vary_least_power, vary_shares
from pendula.studies.breathers.sensitivity import measure_sensitivity
from problems import problem_of

SOLVER = {"name": "taylor", "rtol": 1e-7, "atol": 1e-7}
RUNS = {"tolerance": 1e-7, "end_time": 10.0, "half_width": 12, "majority": MAJORITY}
PROBLEM = problem_of("fig3_large", half_width=12, end_time=10.0, output_step=10.0, solver=SOLVER)


def test_areas_are_those_of_the_map_without_its_diagonal():
    """A longer run is the map of a longer run, and every second point that of a coarser grid."""
    amplitudes = [0.5, 2.0, 3.5, 5.0, 6.5]
    data = vary_areas(PROBLEM, amplitudes, RUNS | {"stride": 1}, {"end_time": [20], "stride": [2]})
    longer = PROBLEM.changed(end_time=20.0, output_step=20.0)
    for problem, chosen, areas in (
        (PROBLEM, amplitudes, data["area"]),
        (longer, amplitudes, data["area_varied"].sel(variation="end_time = 20")),
        (PROBLEM, amplitudes[::2], data["area_varied"].sel(variation="stride = 2")),
    ):
        fates = as_xarray(*map_fates({-4.0: problem}, chosen).make())["fate"].values[0]
        unequal = fates[~np.eye(len(chosen), dtype=bool)]
        expected = [(unequal == place).mean() for place in range(len(FATES))]
        np.testing.assert_allclose(areas, expected)
    assert (data["area_low"] <= data["area_varied"].min("variation")).all()
    assert (data["area_error"] >= data["area_statistical_error"]).all()


def test_shares_are_those_of_as_many_runs_with_another_choice():
    sizes, members = [1e-6, 0.3], 5
    data = vary_shares("fig3_large", PROBLEM, sizes, members, RUNS | {"seed": 4}, {"seed": [5]})
    for seed, share in ((4, data["share"]), (5, data["share_varied"].sel(variation="seed = 5"))):
        recomputed = as_xarray(
            *measure_sensitivity("fig3_large", PROBLEM, sizes, members, seed).make()
        )
        np.testing.assert_array_equal(share, recomputed["share"])
    assert (data["share_low"] <= data["share_varied"].min("variation")).all()


def test_the_least_power_of_breathers_lies_near_the_frequency_8_8():
    """At 8.5 and 9 it is larger, by the values that `snakemake breathers` has."""
    constants = {"epsilon": 1.0, "gamma": 1.0, "omega": -4.0}
    chosen = {"frequency_step": 0.3, "half_width": 16, "steps": 40}
    data = vary_least_power(constants, [8.5, 9.1], chosen, {"half_width": [24], "steps": [80]})
    assert data["least_frequency"].item() == pytest.approx(8.8)
    assert data["least_power"].item() == pytest.approx(30.2522, rel=1e-5)
    assert data["least_power_error"].item() < 1e-6
