"""Datasets are whole and described, have one digest, and their faults name the file."""

import re

import numpy as np
import pytest
import xarray as xr
from latticode.datasets.checks import rounded, variable
from latticode.datasets.digest import digest, digest_values
from latticode.datasets.netcdf import DatasetError, Variable, read, save, write
from latticode.datasets.registry import WAYS, NamingError

SERIES = {
    "tau": Variable(("tau",), np.arange(3.0)),
    "component": Variable(("component",), ["A", "B"], "pendulum of each pair"),
    "l2": Variable(("component", "tau"), np.ones((2, 3)), attributes={"significant_digits": 2}),
}


def test_what_is_written_is_read_with_its_descriptions(tmp_path):
    write(tmp_path / "a.nc", SERIES, {"title": "Norms of mine", "omega": 8.0})
    data = read(tmp_path / "a.nc")
    assert data["l2"].dims == ("component", "tau") and float(data["l2"].sum()) == 6
    assert list(data["component"].values) == ["A", "B"]
    assert data["tau"].attrs["long_name"].endswith("time") and data["tau"].attrs["units"] == "1"
    assert data["l2"].attrs["significant_digits"] == 2
    assert (data.attrs["title"], data.attrs["omega"]) == ("Norms of mine", 8.0)
    assert data.attrs["Conventions"].startswith("CF-")
    assert data.attrs["version"] in data.attrs["history"]


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
    attributes = {"long_name": variable.long_name, "units": variable.units}
    with pytest.raises(NamingError, match=fault):
        save(tmp_path / "a.nc", xr.Dataset({name: ((), variable.values, attributes)}))
    assert not any(tmp_path.iterdir())


def test_saving_states_no_missing_value_and_leaves_the_dataset_alone(tmp_path):
    data = xr.Dataset({"mine": ("tau", [1.0, 2.0], {"long_name": "mine"})}, {"tau": [0.0, 1.0]})
    save(tmp_path / "a.nc", data)
    assert "_FillValue" not in read(tmp_path / "a.nc")["tau"].encoding
    assert data.attrs == {} and data["tau"].attrs == {}


def test_a_missing_and_a_damaged_file_are_named_in_full(tmp_path, monkeypatch):
    """Jobs run in the folder of `--directory`, and the user may have a whole file of this name."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(DatasetError, match=rf"a\.nc is missing: {WAYS['make']}"):
        read("a.nc")
    (tmp_path / "a.nc").write_bytes(b"damaged")
    with pytest.raises(DatasetError, match=f"{re.escape(str(tmp_path))}/a.nc is damaged.*delete"):
        read("a.nc")


def test_what_another_program_has_packed_is_unpacked(tmp_path):
    path = tmp_path / "packed.nc"
    data = xr.Dataset({"l2": ("tau", [0.5, np.nan, 1.5])}, {"tau": [0.0, 1.0, 2.0]})
    packing = {"dtype": "int16", "scale_factor": 0.5, "_FillValue": -1}
    data.to_netcdf(path, encoding={"l2": packing})
    np.testing.assert_array_equal(read(path)["l2"], [0.5, np.nan, 1.5])


# --- Values that a library decides in their last bits -------------------------------------------


@pytest.mark.parametrize(
    ("value", "expected"),
    [(123456.0, 123000.0), (-0.00123456, -0.00123), (0.0, 0.0), (np.inf, np.inf), (9.999, 10.0)],
)
def test_rounding_keeps_significant_digits(value, expected):
    assert rounded(value, 3) == expected


def test_rounded_values_keep_their_shape_and_say_their_digits():
    values = np.array([[1.23456, 2.0], [np.nan, 1e-300 / 3.0]])
    computed = variable(values, ("x", "y"), "values", digits=3)
    assert computed["attrs"]["significant_digits"] == 3
    np.testing.assert_array_equal(computed["data"], [[1.23, 2.0], [np.nan, 3.33e-301]])
    assert "significant_digits" not in variable(values, ("x", "y"), "values")["attrs"]


# --- Digests -------------------------------------------------------------------------------------

VALUES = np.array([[1.0, -0.0, np.inf], [np.nan, 2.5, 1e-300]])
PLACES = ("row", "column")


def change(place, value) -> np.ndarray:
    values = VALUES.copy()
    values[place] = value
    return values


CHANGED = {
    "last bit": (PLACES, change((0, 0), np.nextafter(1.0, 2.0))),
    "sign of zero": (PLACES, change((0, 1), 0.0)),
    "sign of infinity": (PLACES, change((0, 2), -np.inf)),
    "gap filled": (PLACES, change((1, 0), 0.0)),
    "order": (PLACES, VALUES[::-1]),
    "precision": (PLACES, VALUES.astype(np.float32)),
    "dimensions": (("column", "row"), VALUES),
    "shape": (PLACES, VALUES.T),
}


@pytest.mark.parametrize("name", CHANGED)
def test_every_change_of_values_shows(name):
    assert digest_values(*CHANGED[name]) != digest_values(PLACES, VALUES)


def test_letters_moved_between_words_show():
    assert digest_values(("case",), ["ab", "c"]) != digest_values(("case",), ["a", "bc"])


def test_the_sign_of_a_gap_and_the_order_of_bytes_do_not_show():
    signed = change((1, 0), np.copysign(np.nan, -1))
    assert np.signbit(signed[1, 0]) and not np.signbit(VALUES[1, 0])
    for same in (signed, VALUES.astype(">f8"), np.asfortranarray(VALUES)):
        assert digest_values(PLACES, same) == digest_values(PLACES, VALUES)


def test_a_dataset_has_one_digest_in_memory_and_on_disk(tmp_path):
    named = {"long_name": "made up", "units": "1"}
    coordinates = {"case": ["A", "Ω"], "place": ("place", np.arange(3), named)}
    flags = ("case", [True, False], named)
    data = xr.Dataset({"value": (("case", "place"), VALUES, named), "flag": flags}, coordinates)
    save(tmp_path / "data.nc", data)
    assert digest(read(tmp_path / "data.nc")) == digest(data)
    assert digest(data.rename(value="other")) != digest(data)
    assert digest(data.rename(value="flag", flag="value")) != digest(data)
