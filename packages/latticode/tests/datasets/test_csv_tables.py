"""Tables in CSV have a column for each number, with its name and units, and all digits."""

import csv

import numpy as np
import pytest
import xarray as xr
from latticode import DatasetError, save


def described(dims, values, units="1"):
    return xr.Variable(dims, np.asarray(values), {"long_name": "a number", "units": units})


RUN = xr.Dataset(
    {
        "l2": described(("component", "tau"), [[1.0, 1 / 3], [0.0, 2.0]], "rad"),
        "energy": described(("tau",), [4.0, 5.0]),
        "modulus": described(("component", "snapshot"), [[7.0], [8.0]]),
    },
    {"tau": described(("tau",), [0.0, 0.5]), "component": ["A", "B"]},
)
SURVEY = xr.Dataset(
    {"final": described(("omega", "member", "component"), np.arange(6.0).reshape(2, 3, 1))},
    {"omega": described(("omega",), [-1.0, 1.0]), "member": range(3), "component": ["u"]},
)


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def test_norms_have_a_row_for_each_time(tmp_path):
    save(tmp_path / "run.csv", RUN)
    head, first, second = rows_of(tmp_path / "run.csv")
    assert head == ["tau [1]", "l2 A [rad]", "l2 B [rad]", "energy [1]"]
    assert list(map(float, first)) == [0.0, 1.0, 0.0, 4.0]
    assert list(map(float, second)) == [0.5, 1 / 3, 2.0, 5.0]


def test_a_survey_has_a_row_for_each_run(tmp_path):
    save(tmp_path / "survey.csv", SURVEY.transpose("component", "member", "omega"))
    head, *rows = rows_of(tmp_path / "survey.csv")
    assert sorted(head) == ["final u [1]", "member [1]", "omega [1]"]
    places = [head.index(name) for name in ("omega [1]", "member [1]", "final u [1]")]
    computed = {tuple(float(row[i]) for i in places) for row in rows}
    assert computed == {(omega, n, n + 3 * (omega > 0)) for omega in (-1.0, 1.0) for n in range(3)}


def test_what_is_no_table_is_refused(tmp_path):
    with pytest.raises(DatasetError, match="has no norms"):
        save(tmp_path / "no.csv", xr.Dataset({"growth": 1.0}))
    assert not list(tmp_path.iterdir())


def test_a_file_of_another_kind_is_refused(tmp_path):
    with pytest.raises(DatasetError, match=r"a\.xlsx: datasets are saved as netCDF"):
        save(tmp_path / "a.xlsx", RUN)
    assert not list(tmp_path.iterdir())
