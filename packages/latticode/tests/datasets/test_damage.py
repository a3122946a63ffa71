"""A file that a disk gives back wrong is rejected in one sentence, or holds what was written."""

import json
import random

import numpy as np
import pytest
import xarray as xr
from dimers import dimers
from latticode.datasets import netcdf
from latticode.datasets.json_files import load_json, write_json
from latticode.datasets.netcdf import DatasetError, as_xarray, read, readable, save
from latticode.datasets.registry import WAYS
from latticode.datasets.surveys import survey_contents
from latticode.datasets.trajectories import trajectory_contents
from latticode.simulation.simulate import simulate
from latticode.simulation.survey import Survey
from latticode.simulation.survey_runs import run_survey

FLIPS = 200


def a_run():
    problem = dimers(snapshot_every=1, half_width=30, output_step=0.0625)
    return trajectory_contents("mine", problem, simulate(problem))


def a_survey():
    problem, survey = dimers(), Survey({"omega": [-4.0, 0.0]}, ("max_l2", "exponent"))
    return survey_contents("map", problem, survey, run_survey(problem, survey))


@pytest.fixture(params=[a_run, a_survey])
def dataset(request, tmp_path):
    """Return the file of a dataset: numbers, words and single values."""
    save(tmp_path / "a.nc", as_xarray(*request.param()))
    return tmp_path / "a.nc"


def flipped(content, bit):
    changed = bytearray(content)
    changed[bit // 8] ^= 1 << bit % 8
    return changed


def test_a_flipped_bit_is_rejected_or_changes_nothing(dataset):
    content, intact, rejected = dataset.read_bytes(), read(dataset), 0
    for bit in random.Random(0).sample(range(8 * len(content)), FLIPS):
        dataset.write_bytes(flipped(content, bit))
        try:
            computed = read(dataset)
        except DatasetError as error:
            assert f"{dataset} is damaged" in str(error) and "delete it" in str(error)
            rejected += 1
        else:
            assert computed.identical(intact), f"bit {bit} changed the content"
    assert rejected > 0.9 * FLIPS


def test_a_reader_without_our_library_is_told_of_a_flipped_number(dataset):
    """The checksums of HDF5: a bit is flipped in the middle of the largest variable."""
    variables = xr.load_dataset(dataset, engine="netcdf4").variables.values()
    numbers = (first for first in variables if first.dtype.kind == "f")
    largest = max(numbers, key=lambda variable: variable.nbytes)
    content = dataset.read_bytes()
    place = content.index(np.ascontiguousarray(largest.values).tobytes()[:64])
    dataset.write_bytes(flipped(content, 8 * place + 100))
    with pytest.raises((OSError, RuntimeError)):
        xr.load_dataset(dataset, engine="netcdf4")


def test_the_same_content_gives_the_same_bytes(dataset, tmp_path):
    data = read(dataset)
    for name in ("b.nc", "c.nc"):
        save(tmp_path / name, data)
    assert (tmp_path / "b.nc").read_bytes() == (tmp_path / "c.nc").read_bytes()
    assert read(tmp_path / "b.nc").identical(data)


def test_a_dataset_cut_anywhere_is_rejected(dataset):
    content = dataset.read_bytes()
    for length in (0, 1, 100, len(content) // 2, len(content) - netcdf.LENGTH - 1):
        dataset.write_bytes(content[:length])
        with pytest.raises(
            DatasetError, match=rf"a\.nc is damaged .* delete it and {WAYS['make']}"
        ):
            read(dataset)


@pytest.mark.parametrize(
    ("path", "words"), [("", "is a folder: give"), ("/", "^/ is a folder: give"), (3, "not a int")]
)
def test_what_is_no_file_at_all_is_not_to_be_deleted(path, words):
    with pytest.raises(DatasetError, match=words) as message:
        read(path)
    assert "delete" not in str(message.value)


def test_whatever_a_library_makes_of_a_damaged_file_names_it(tmp_path):
    (tmp_path / "a.json").write_text("{")
    with (
        pytest.raises(DatasetError, match=r"a\.json is damaged .*KeyError"),
        readable(tmp_path / "a.json"),
    ):
        raise KeyError


def test_a_changed_byte_of_json_is_told_wherever_it_is(tmp_path):
    path = tmp_path / "claims.json"
    write_json(path, {"rows": [{"says": "Ω > 2γ", "measured": 0.25, "verdict": "reproduced"}]})
    content = path.read_bytes()
    assert load_json(path)["rows"][0]["says"] == "Ω > 2γ" and "sha256" in json.loads(content)
    changed = [
        content[:i] + bytes([content[i] ^ 1]) + content[i + 1 :] for i in range(len(content))
    ]
    for wrong in (*changed, content[:-3], content + b" ", b"", b'{"rows": []}'):
        path.write_bytes(wrong)
        with pytest.raises(
            DatasetError, match=rf"claims\.json is damaged .* {WAYS['make']} to make"
        ):
            load_json(path)
