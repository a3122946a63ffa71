"""How cost grows, and what the machine could do."""

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.netcdf import read, write
from pendula.plots import cost_growth
from pendula.speed import growth, limits, machine
from pendula.speed.growth_table import write_table
from scipy.integrate._ivp import dop853_coefficients as published


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(growth, "SITES", (11, 101))
        patch.setattr(growth, "END_TIMES", (1.0, 4.0))
        patch.setattr(growth, "REPEAT", 1)
        patch.setattr(growth, "WORK", 100)
        patch.setattr(limits, "LONG", 10_000)
        problem = {
            "epsilon": 1.0, "gamma": 1.0, "omega": -4.0, "half_width": 4,
            "boundary": "dirichlet", "initial": {0: (1.0, 0.1)},
        }  # fmt: skip
        variables = growth.measure(problem)
    path = tmp_path_factory.mktemp("growth") / "growth.nc"
    write(path, variables, machine.describe())
    return read(path)


def test_the_noisy_chain_is_even_and_the_same_every_time():
    z = growth.noisy_chain(11)
    np.testing.assert_array_equal(z, z[:, ::-1])
    np.testing.assert_array_equal(z, growth.noisy_chain(11))
    assert z.shape == (2, 11)


def test_memory_grows_with_the_chain_and_not_faster(measured):
    memory = measured["memory"].sel(solver="dop853").values
    assert 400 < memory[1] < memory[0] < 2000  # 38 arrays of 4 numbers for each site of a half


def test_no_run_is_faster_than_the_machine(measured):
    data = cost_growth.gather(measured)
    assert bool((data["carried"].sel(solver="dop853") < 2 * data["arithmetic_limit"]).all())
    assert len(cost_growth.draw(data).axes) == 3


def made_up_growth():
    """Return costs of 2 and 3 µs at 1001 sites, of 3 and 6 at 100 001."""
    costs = 1e-6 * np.array([[2.0, 3.0], [3.0, 6.0]])
    return xr.Dataset(
        {
            "seconds": (("sites", "solver"), costs),
            "long_seconds": (("end_time", "solver"), costs[:1]),
        },
        coords={
            "sites": ("sites", [1001, 100_001], {"long_name": "number of sites N"}),
            "end_time": ("end_time", [10.0], {"long_name": "slow time at the end"}),
            "solver": ["dop853", "taylor"],
        },
    )


def test_the_table_says_what_was_measured():
    lines = write_table(made_up_growth()).splitlines()
    assert "| 1001 | 2 | 3 |" in lines and "| 100001 over 1001 | 1.5 | 2 |" in lines
    assert "| 10 | 2 | 3 |" in lines


def test_the_table_compares_only_chains_that_were_measured():
    short = made_up_growth().isel(sites=[0])
    assert " over 1001" not in write_table(short)


def test_operations_are_those_of_the_published_coefficients():
    operations, traffic = limits.count_dop853()
    weights = np.count_nonzero(published.A[:12]) + np.count_nonzero(published.B)
    estimates = np.count_nonzero(published.E3) + np.count_nonzero(published.E5)
    # 12 right-hand sides of 13.5 operations, two for each weight, and the norms of the errors
    assert operations == 4 * (12 * 13.5 + 2 * (weights + estimates) + 12)
    assert traffic == 4 * 32  # state and slope, read and written


def test_the_machine_is_described():
    assert {"processor", "python", "numpy", "numba", "scipy"} == set(machine.describe())
