"""A file that a disk gives back wrong is refused in one sentence, or holds what was written."""

import json
import random

import numpy as np
import pytest
import xarray as xr
from oracle import SOLVERS
from pendula.datasets import netcdf
from pendula.datasets.json_files import load_json, write_json
from pendula.datasets.netcdf import DatasetError, Variable, read, readable, save, write
from pendula.datasets.trajectories import sweep_contents, trajectory_contents
from pendula.simulation.simulate import simulate
from pendula.simulation.sweep import sweep
from problems import problem_of

FLIPS = 200


def trajectory():
    problem = problem_of("fig2_small", end_time=30.0, snapshot_every=40, solver=SOLVERS["taylor"])
    return trajectory_contents("mine", problem, simulate(problem))


def sweep_of_three():
    problem, chains, windows = problem_of("fig2_small", end_time=3.0), [2, 4, 8], [(1.0, 3.0)]
    return sweep_contents("mine", problem, chains, windows, sweep(problem, chains, windows))


def ensemble():
    rng = np.random.default_rng(0)
    peaks = Variable(("member", "tau"), rng.random((30, 100)), "largest norm")
    members = Variable(("member",), np.arange(30))
    return {"member": members, "peaks": peaks, "seed": Variable((), 7, "seed")}, {"size": 1e-9}


@pytest.fixture(params=[trajectory, sweep_of_three, ensemble])
def dataset(request, tmp_path):
    path = tmp_path / "a.nc"
    write(path, *request.param())
    return path


def flipped(content, bit):
    changed = bytearray(content)
    changed[bit // 8] ^= 1 << bit % 8
    return changed


def test_a_flipped_bit_is_refused_or_changes_nothing(dataset):
    content, whole, refused = dataset.read_bytes(), read(dataset), 0
    rng = random.Random(0)
    for bit in rng.sample(range(8 * len(content)), FLIPS):
        dataset.write_bytes(flipped(content, bit))
        try:
            found = read(dataset)
        except DatasetError as error:
            assert f"{dataset} is damaged" in str(error) and "delete it" in str(error)
            refused += 1
        else:
            assert found.identical(whole), f"bit {bit} changed the content"
    assert refused > 0.9 * FLIPS


def test_a_reader_without_our_library_is_told_of_a_flipped_number(dataset):
    """The checksums of HDF5: a bit is flipped in the middle of the largest variable."""
    variables = xr.load_dataset(dataset, engine="netcdf4").variables
    largest = max(variables.values(), key=lambda variable: variable.nbytes)
    content = dataset.read_bytes()
    numbers = content.find(np.ascontiguousarray(largest.values).tobytes()[:64])
    if numbers < 0:  # compressed, and most of the file
        numbers = len(content) // 2
    dataset.write_bytes(flipped(content, 8 * numbers + 100))
    with pytest.raises((OSError, RuntimeError)):
        xr.load_dataset(dataset, engine="netcdf4")


def test_the_seal_is_the_same_for_the_same_content_however_it_is_written(dataset, tmp_path):
    data = read(dataset)
    for name in ("b.nc", "c.nc"):
        save(tmp_path / name, data)
    assert (tmp_path / "b.nc").read_bytes() == (tmp_path / "c.nc").read_bytes()
    assert read(tmp_path / "b.nc").identical(data)


def test_a_dataset_cut_anywhere_is_refused(dataset):
    content = dataset.read_bytes()
    for kept in (0, 1, 100, len(content) // 2, len(content) - netcdf.LENGTH - 1):
        dataset.write_bytes(content[:kept])
        with pytest.raises(DatasetError, match=r"a\.nc is damaged .* delete it and run snakemake"):
            read(dataset)


@pytest.mark.parametrize("content", [b"", b"{", b"\x93NUMPY", b"PK\x03\x04"])
def test_a_file_of_another_kind_is_refused(tmp_path, content):
    (tmp_path / "a.nc").write_bytes(content)
    with pytest.raises(DatasetError, match=r"a\.nc is damaged"):
        read(tmp_path / "a.nc")


@pytest.mark.parametrize(
    ("path", "words"), [("", "is a folder: name"), ("/", "^/ is a folder: name"), (3, "not a int")]
)
def test_what_is_no_file_at_all_is_not_to_be_deleted(path, words):
    with pytest.raises(DatasetError, match=words) as told:
        read(path)
    assert "delete" not in str(told.value)


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
    for place in range(len(content)):
        path.write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :])
        with pytest.raises(DatasetError, match=r"claims\.json is damaged .*run snakemake to make"):
            load_json(path)


@pytest.mark.parametrize("change", ["whole", "shorter", "longer", "absent"])
def test_json_by_hand_is_told_by_its_missing_checksum(tmp_path, change):
    path = tmp_path / "claims.json"
    write_json(path, {"rows": []})
    text = path.read_text()
    by_hand = {"whole": '{"rows": []}', "shorter": text[:-3], "longer": text + " ", "absent": ""}
    path.write_text(by_hand[change])
    with pytest.raises(DatasetError, match="delete it and run snakemake"):
        load_json(path)
