"""A disk that takes no more, or something in the way: no half of a file, and a way out in words."""

import errno
import os
import resource
import signal
import subprocess
import sys
import tempfile

import numpy as np
import pytest
import xarray as xr
from latticode.datasets import DatasetError, complete_or_absent
from latticode.datasets.netcdf import Variable, write
from latticode.drawing.light_fonts import light_fonts
from latticode.drawing.style import new_figure, save


@pytest.fixture
def full_disk():
    """Make every write fail beyond some kilobytes: a limit on sizes stands for the full disk."""
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4_000, limits[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    signal.signal(signal.SIGXFSZ, ignored)


def write_text(path):
    with complete_or_absent(path) as partial:
        partial.write_text("x" * 10_000)


def write_dataset(path):
    write(path, {"many": Variable(("n",), np.random.rand(100_000), "many")}, {})


def write_figure(path):
    figure = new_figure(3, 2)
    figure.add_subplot().plot([0, 1], [0, 1])
    kinds = ("png", "pdf", "nc", "json")
    save(figure, xr.Dataset(), *(path.with_suffix(f".{kind}") for kind in kinds))


@pytest.mark.parametrize("put", [write_text, write_dataset, write_figure])
def test_a_full_disk_is_named_and_keeps_the_old_file(put, tmp_path, full_disk):
    path = tmp_path / "a.nc"
    path.write_bytes(b"old")
    with pytest.raises(DatasetError, match=r"could not write .*/a\..*disk full.* left.*make room"):
        put(path)
    assert [p.name for p in tmp_path.iterdir()] == ["a.nc"] and path.read_bytes() == b"old"


def test_a_full_disk_of_temporary_files_is_named_in_place_of_that_of_the_figure(
    tmp_path, full_disk, monkeypatch
):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    words = rf"could not write {tmp_path}/.*DejaVuSans\.ttf: .*disk full"
    with (
        pytest.raises(DatasetError, match=words),
        complete_or_absent(tmp_path / "a.pdf"),
        light_fonts(),
    ):
        pass


def test_where_no_folder_takes_temporary_files_the_variable_that_names_one_is_told(monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", None)
    monkeypatch.setattr(tempfile, "_candidate_tempdir_list", lambda: ["/proc/absent"])
    words = r"/proc/absent.*: free space in one of them, or set TMPDIR"
    with pytest.raises(DatasetError, match=words), light_fonts():
        pass


def test_a_file_inside_of_another_is_told_by_the_name_of_the_outer_one(tmp_path):
    path = tmp_path / "a.nc"
    with (
        pytest.raises(DatasetError, match=rf"could not write {path}: "),
        complete_or_absent(path) as outer,
        complete_or_absent(outer),
    ):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_what_stands_in_the_way_is_named_and_stays(tmp_path):
    (tmp_path / "results").write_text("mine")
    (tmp_path / "a.png").mkdir()
    for name, words in (
        ("results/figures/b.png", r"b\.png: .*results is a file, not a folder; move it"),
        ("a.png", r"a\.png: it is a folder; move it"),
    ):
        with (
            pytest.raises(DatasetError, match=words),
            complete_or_absent(tmp_path / name) as partial,
        ):
            partial.touch()
    assert (tmp_path / "results").read_text() == "mine"
    assert {path.name for path in tmp_path.iterdir()} == {"results", "a.png"}


def test_what_a_killed_process_left_goes_and_that_of_a_living_one_stays(tmp_path):
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    for process in (dead.pid, os.getppid()):
        (tmp_path / f".{process}.a.nc").touch()
    (tmp_path / ".mine.a.nc").touch()
    with complete_or_absent(tmp_path / "a.nc") as partial:
        partial.touch()
    assert {path.name for path in tmp_path.iterdir()} == {
        "a.nc",
        f".{os.getppid()}.a.nc",
        ".mine.a.nc",
    }


def test_a_fault_of_another_file_is_told_as_it_is(tmp_path):
    with pytest.raises(FileNotFoundError), complete_or_absent(tmp_path / "a"):
        (tmp_path / "b").read_text()


def test_a_read_only_folder_is_named(tmp_path, monkeypatch):
    """Asked of the system's answer: root may write everywhere."""
    monkeypatch.setattr(os, "access", lambda folder, mode: False)
    with (
        pytest.raises(DatasetError, match=rf"Read-only file system; make {tmp_path} writable"),
        complete_or_absent(tmp_path / "a") as partial,
    ):
        raise OSError(errno.EROFS, os.strerror(errno.EROFS), str(partial))
