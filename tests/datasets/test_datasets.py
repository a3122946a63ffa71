"""Datasets are whole, described, and their faults name the file."""

import resource
import signal

import numpy as np
import pytest
from pendula.datasets.netcdf import DatasetError, Variable, read, write

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


def test_two_writes_give_the_same_bytes(tmp_path):
    for name in ("a.nc", "b.nc"):
        write(tmp_path / name, SERIES, {"case": "mine"})
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(DatasetError, match=r"none\.nc is missing: run snakemake"):
        read(tmp_path / "none.nc")


@pytest.mark.parametrize("keep", [0, 100, 2000])
def test_a_damaged_file_is_named_with_the_way_out(tmp_path, keep):
    path = tmp_path / "a.nc"
    write(path, {**SERIES, "long": Variable(("n",), np.random.rand(9000), "many")}, {})
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(DatasetError, match=r"a\.nc is damaged .* delete it and run snakemake"):
        read(path)


def test_a_full_disk_leaves_no_file_and_keeps_the_old_one(tmp_path):
    """The limit on a file's size stands for the full disk: the write fails half-way."""
    path = tmp_path / "a.nc"
    write(path, SERIES, {"case": "old"})
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, limits[1]))
    try:
        big = {"many": Variable(("n",), np.random.rand(100_000), "many")}
        with pytest.raises(DatasetError, match=r"could not write .*a\.nc.*disk full"):
            write(path, big, {"case": "new"})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, ignored)
    assert [p.name for p in tmp_path.iterdir()] == ["a.nc"]
    assert read(path).attrs["case"] == "old"
