"""Datasets are whole, described, and their faults name the file."""

import re

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.netcdf import DatasetError, Variable, read, save, write
from pendula.datasets.registry import NamingError

SERIES = {
    "tau": Variable(("tau",), np.arange(3.0), "slow time"),
    "component": Variable(("component",), ["A", "B"], "pendulum of each pair"),
    "l2": Variable(("component", "tau"), np.ones((2, 3)), "l2 norm"),
}


def test_what_is_written_is_read(tmp_path):
    write(tmp_path / "a.nc", SERIES, {"case": "mine", "omega": 8.0})
    data = read(tmp_path / "a.nc")
    assert data["l2"].dims == ("component", "tau") and float(data["l2"].sum()) == 6
    assert list(data["component"].values) == ["A", "B"]
    assert data.attrs["case"] == "mine" and data["l2"].attrs["long_name"] == "l2 norm"
    assert data["l2"].attrs["units"] == "1"


def test_a_rounded_variable_says_its_digits(tmp_path):
    write(tmp_path / "a.nc", {"l2": Variable((), 0.3, attributes={"significant_digits": 2})}, {})
    assert read(tmp_path / "a.nc")["l2"].attrs["significant_digits"] == 2


def test_every_file_says_what_it_is_and_by_what_it_was_made(tmp_path):
    write(tmp_path / "a.nc", SERIES, {"title": "Norms of mine"})
    attributes = read(tmp_path / "a.nc").attrs
    assert attributes["title"] == "Norms of mine" and attributes["Conventions"].startswith("CF-")
    assert attributes["version"] in attributes["history"]


def test_a_name_of_the_registry_needs_no_description(tmp_path):
    write(tmp_path / "a.nc", {"tau": Variable(("tau",), np.arange(3.0))}, {})
    assert read(tmp_path / "a.nc")["tau"].attrs == {"long_name": "slow time", "units": "1"}


@pytest.mark.parametrize(
    ("name", "variable", "fault"),
    [
        ("mine", Variable((), 1.0), "mine: has no long_name"),
        ("mine", Variable((), 1.0, "a rate", "tau^-1"), r"mine: has the units 'tau\^-1'"),
        ("tau", Variable((), 1.0, "slow time", "s"), "tau: has the units 's'"),
    ],
)
def test_a_variable_that_nobody_could_read_is_not_written(tmp_path, name, variable, fault):
    with pytest.raises(NamingError, match=fault):
        write(tmp_path / "a.nc", {name: variable}, {})
    with pytest.raises(NamingError, match=fault):
        values = variable.values
        attributes = {"long_name": variable.long_name, "units": variable.units}
        save(tmp_path / "a.nc", xr.Dataset({name: ((), values, attributes)}))
    assert not any(tmp_path.iterdir())


def test_saving_states_no_missing_value_and_leaves_the_dataset_alone(tmp_path):
    data = xr.Dataset({"mine": ("tau", [1.0, 2.0], {"long_name": "mine"})}, {"tau": [0.0, 1.0]})
    save(tmp_path / "a.nc", data)
    assert "_FillValue" not in read(tmp_path / "a.nc")["tau"].encoding
    assert data.attrs == {} and data["tau"].attrs == {}


def test_two_writes_give_the_same_bytes(tmp_path):
    for name in ("a.nc", "b.nc"):
        write(tmp_path / name, SERIES, {"title": "mine"})
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


def test_a_damaged_file_is_named_in_full(tmp_path, monkeypatch):
    """Jobs run in the folder of `--directory`, and the user may have a whole file of this name."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.nc").write_bytes(b"damaged")
    with pytest.raises(DatasetError, match=f"{re.escape(str(tmp_path))}/a.nc is damaged.*delete"):
        read("a.nc")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(DatasetError, match=r"none\.nc is missing: run snakemake"):
        read(tmp_path / "none.nc")


def test_what_others_write_is_read_too(tmp_path):
    xr.Dataset({"mine": ("n", [1.0, 2.0])}).to_netcdf(tmp_path / "a.nc")
    assert list(read(tmp_path / "a.nc")["mine"].values) == [1.0, 2.0]


def test_what_another_program_has_packed_is_unpacked(tmp_path):
    path = tmp_path / "packed.nc"
    data = xr.Dataset({"l2": ("tau", [0.5, np.nan, 1.5])}, {"tau": [0.0, 1.0, 2.0]})
    packing = {"dtype": "int16", "scale_factor": 0.5, "_FillValue": -1}
    data.to_netcdf(path, encoding={"l2": packing})
    np.testing.assert_array_equal(read(path)["l2"], [0.5, np.nan, 1.5])
