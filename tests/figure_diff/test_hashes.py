"""The hashes of datasets: what changes them, what does not, and what the baseline keeps."""

import json

import netCDF4
import numpy as np
import pytest
import xarray as xr
from made_up_results import CHAOTIC, NAMES, REGULAR, change_a, regular
from pendula.datasets.netcdf import DatasetError, save
from pendula.figure_diff import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, baseline, hashes


@pytest.fixture
def stored(tmp_path):
    """Return a function: a dataset as a file holds it."""

    def store(data: xr.Dataset) -> hashes.Content:
        save(tmp_path / "data.nc", data)
        return hashes.read(tmp_path / "data.nc")

    return store


@pytest.fixture
def of(stored):
    """Return a function: the hashes of a dataset."""
    return lambda data: hashes.of(stored(data))


def values(change) -> xr.Dataset:
    """Return the regular dataset with the values of l2 changed in place."""
    data = regular()
    change(data["l2"].values)
    return data


def test_only_the_variable_that_changed_has_another_hash(of):
    def move_one_number_by_its_last_bit(l2):
        l2[1, 777] = np.nextafter(l2[1, 777], 9)

    was, now = of(regular()), of(values(move_one_number_by_its_last_bit))
    assert hashes.unlike_in_values(was, now) == ["l2"]
    assert hashes.same_attributes(was, now) and not hashes.unlike_in_kind(was, now)


def test_numbers_that_change_places_have_another_hash(of):
    def swap(l2):
        l2[:, [3, 4]] = l2[:, [4, 3]]

    assert hashes.unlike_in_values(of(regular()), of(values(swap))) == ["l2"]


def test_words_that_share_their_letters_have_another_hash(of):
    renamed = regular().assign_coords(component=["AB", ""])
    parted = regular().assign_coords(component=["A", "B"])
    assert hashes.unlike_in_values(of(parted), of(renamed)) == ["component"]


def test_neither_byte_order_nor_the_sign_of_nan_counts(tmp_path):
    found = []
    for kind, gap in (("<f8", np.nan), (">f8", np.copysign(np.nan, -1))):
        with netCDF4.Dataset(tmp_path / "data.nc", "w") as file:
            file.createDimension("tau", 3)
            order = {"<": "little", ">": "big"}[kind[0]]
            l2 = file.createVariable("l2", kind, ("tau",), endian=order)
            l2[...] = np.array([1.5, gap, 2.5], kind)
        found.append(hashes.of(hashes.read(tmp_path / "data.nc")))
    assert found[0] == found[1]


def test_the_version_of_the_project_is_no_result(of):
    first = of(regular())
    assert first == of(regular().assign_attrs(version="9.9"))
    with_other_data = of(regular().assign_attrs(omega=-4.0))
    assert not hashes.same_attributes(first, with_other_data)


@pytest.mark.parametrize("hidden", ["variable", "attribute"])
def test_what_lies_in_a_group_counts(run, hidden):
    with netCDF4.Dataset(run.made / REGULAR, "a") as file:
        group = file.createGroup("older")
        if hidden == "variable":
            group.createVariable("l2", "f8", ("tau",))[...] = 1.0
        else:
            group.omega = 8.0
    found = run.findings()[REGULAR]
    named = {"variable": "older/l2 is new", "attribute": "attribute older/omega is 8.0"}[hidden]
    assert found.status == DIFFERENT and named in found.says


def test_hashes_are_plain_json_with_a_line_for_each_variable(run):
    text = (run.accepted / baseline.HASHES).read_text()
    l2 = json.loads(text)[REGULAR]["variables"]["l2"]
    assert l2["type"] == "float64" and l2["shape"] == "component 2, tau 2001"
    (line,) = [line for line in text.splitlines() if l2["values"] in line and '"l2"' in line][:1]
    assert json.loads("{" + line.strip().rstrip(",") + "}") == {"l2": l2}


def test_a_version_in_the_file_does_not_count(stored):
    content = stored(regular())
    newer = content._replace(attributes=content.attributes | {"version": "9.9", "history": "new"})
    assert hashes.of(newer) == hashes.of(content)


def test_what_is_kept_is_every_sample_in_single_precision(run):
    kept, made = (hashes.read(folder / REGULAR) for folder in (run.accepted, run.made))
    l2 = kept.variables["l2"].values
    assert l2.dtype == np.float32 and l2.shape == made.variables["l2"].values.shape
    assert np.array_equal(l2, made.variables["l2"].values.astype(np.float32))
    assert kept.attributes == made.attributes
    with netCDF4.Dataset(run.accepted / REGULAR) as data:
        assert data["l2"].filters() | {"zlib": True, "complevel": 9, "shuffle": True} == (
            data["l2"].filters()
        )


def test_numbers_that_single_precision_cannot_hold_are_kept_as_they_are(stored):
    tiny = hashes.as_kept(stored(values(lambda l2: np.multiply(l2, 1e-60, out=l2))))
    assert tiny.variables["l2"].values.dtype == np.float64
    assert tiny.variables["tau"].values.dtype == np.float32


def test_a_variable_that_declares_more_digits_than_single_precision_keeps_them(stored):
    content = stored(regular())
    for digits, kept in ((7, np.float32), (8, np.float64)):
        l2 = content.variables["l2"]
        declared = l2._replace(attributes=l2.attributes | {"significant_digits": digits})
        found = hashes.as_kept(content._replace(variables={"l2": declared}))
        assert found.variables["l2"].values.dtype == kept


def test_a_dataset_is_what_a_reader_of_the_file_would_get(stored, tmp_path):
    content = stored(regular())
    xr.testing.assert_identical(
        hashes.as_dataset(content), xr.load_dataset(tmp_path / "data.nc", engine="netcdf4")
    )


def test_a_damaged_file_is_named(tmp_path):
    (tmp_path / "data.nc").write_bytes(b"")
    with pytest.raises(DatasetError, match=r"data\.nc is damaged"):
        hashes.read(tmp_path / "data.nc")


def test_the_accepted_hash_decides_without_the_numbers(run, monkeypatch):
    """What the baseline keeps is not even opened, so that a whole run is compared in seconds."""
    read = hashes.read

    def read_new(path):
        assert run.made in path.parents
        return read(path)

    monkeypatch.setattr(hashes, "read", read_new)
    assert run.findings()[REGULAR].status == IDENTICAL


def test_no_dataset_is_opened_twice(run, monkeypatch):
    opened, read = [], hashes.read

    def count(path):
        opened.append(path)
        return read(path)

    monkeypatch.setattr(hashes, "read", count)
    run.change(CHAOTIC, lambda data: data * (1 + 1e-9))
    run.compare(NAMES)
    assert len(opened) == len(set(opened)) == 1 + sum(name.endswith(".nc") for name in NAMES)


def test_other_bits_are_never_identical_however_small_the_change(run):
    run.change(REGULAR, lambda data: change_a(data, 1 + 1e-13))
    found = run.findings()[REGULAR]
    assert found.status == NEARLY
    assert found.says == "other bits in l2, by less than single precision shows (6e-8)"


def test_counts_of_work_follow_numbers_and_nothing_else(run):
    def count(data, steps, factor=1.0):
        return change_a(data, factor).assign_attrs(steps=steps, right_hand_sides=6 * steps)

    run.change(REGULAR, lambda data: count(data, 1550, 1 + 1e-7))
    assert run.findings()[REGULAR].status == NEARLY
    run.change(REGULAR, lambda data: count(data, 1700))
    found = run.findings()[REGULAR]
    assert found.status == DIFFERENT and "attribute steps is 1700 in place of 1500" in found.says
    run.change(REGULAR, lambda data: regular().assign_attrs(steps=1501))
    found = run.findings()[REGULAR]
    assert found.status == DIFFERENT and "attribute steps is 1501 in place of 1500" in found.says


def test_edited_hashes_are_found(run):
    """Else an edited hash could make a wrong file identical."""
    run.change(REGULAR, lambda data: change_a(data, 1.01))
    path = run.accepted / baseline.HASHES
    accepted = json.loads(path.read_text())
    accepted[REGULAR] = hashes.of(hashes.read(run.made / REGULAR))
    path.write_text(json.dumps(accepted))
    (fault,) = run.faults()
    assert fault.startswith(f"{DAMAGED}: {baseline.HASHES}: in the baseline was edited")
