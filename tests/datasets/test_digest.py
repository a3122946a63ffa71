"""Digests: what changes them, and what does not."""

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.digest import digest, digest_values
from pendula.datasets.netcdf import read, save

VALUES = np.array([[1.0, -0.0, np.inf], [np.nan, 2.5, 1e-300]])
DIMENSIONS = ("row", "column")


def change(place, value) -> np.ndarray:
    values = VALUES.copy()
    values[place] = value
    return values


@pytest.mark.parametrize(
    "values",
    [
        change((0, 0), np.nextafter(1.0, 2.0)),
        change((0, 1), 0.0),
        change((0, 2), -np.inf),
        change((1, 0), 0.0),
        VALUES[::-1],
        VALUES.astype(np.float32),
    ],
    ids=["last bit", "sign of zero", "sign of infinity", "gap filled", "order", "precision"],
)
def test_every_change_of_values_shows(values):
    assert digest_values(DIMENSIONS, values) != digest_values(DIMENSIONS, VALUES)


def test_other_dimensions_and_other_words_show():
    assert digest_values(("column", "row"), VALUES) != digest_values(DIMENSIONS, VALUES)
    assert digest_values(("row", "column"), VALUES.T) != digest_values(DIMENSIONS, VALUES)
    assert digest_values(("case",), ["ab", "c"]) != digest_values(("case",), ["a", "bc"])


def test_the_sign_of_a_gap_and_the_order_of_bytes_do_not_show():
    signed = change((1, 0), np.copysign(np.nan, -1))
    assert np.signbit(signed[1, 0]) and not np.signbit(VALUES[1, 0])
    for same in (signed, VALUES.astype(">f8"), np.asfortranarray(VALUES)):
        assert digest_values(DIMENSIONS, same) == digest_values(DIMENSIONS, VALUES)


def test_a_dataset_has_one_digest_in_memory_and_on_disk(tmp_path):
    named = {"long_name": "made up", "units": "1"}
    coordinates = {"case": ["A", "Ω"], "place": ("place", np.arange(3), named)}
    flags = ("case", [True, False], named)
    data = xr.Dataset({"value": (("case", "place"), VALUES, named), "flag": flags}, coordinates)
    save(tmp_path / "data.nc", data)
    assert digest(read(tmp_path / "data.nc")) == digest(data)
    assert digest(data.rename(value="other")) != digest(data)
    assert digest(data.rename(value="flag", flag="value")) != digest(data)
