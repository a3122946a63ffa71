"""Times of results outlive a copy that loses them, and nothing else gets a time that it had not."""

import os
import shutil
from pathlib import Path

import file_times
import pytest

ORDER = ["code/a.txt", "trajectories/a.nc", "figures/a.png"]
"""Made in this order, a second apart."""


@pytest.fixture
def results(tmp_path):
    folder = tmp_path / "results"
    for second, name in enumerate(ORDER, 1):
        path = folder / name
        path.parent.mkdir(parents=True)
        path.write_text(name)
        os.utime(path, (second, second))
    file_times.keep(folder)
    return folder


def copied(results) -> Path:
    """Return a copy in which the last result seems to be the oldest."""
    copy = shutil.copytree(results, results.with_name("copy"), copy_function=shutil.copy)
    for second, name in enumerate(reversed(ORDER), 1000):
        os.utime(copy / name, (second, second))
    return copy


def times(folder) -> list[float]:
    return [(folder / name).stat().st_mtime for name in ORDER]


def test_a_copy_without_times_gets_them_back(results):
    copy = copied(results)
    file_times.restore(copy)
    assert times(copy) == times(results) == [1, 2, 3]


def test_a_result_that_changed_meanwhile_keeps_its_time(results):
    copy = copied(results)
    (copy / ORDER[1]).write_text("another")
    os.utime(copy / ORDER[1], (2000, 2000))
    file_times.restore(copy)
    assert times(copy) == [1, 2000, 3]


def test_what_is_no_copy_is_left_alone(results):
    os.utime(results / ORDER[0], (9, 9))
    file_times.restore(results)
    assert times(results) == [9, 2, 3]


def test_a_copy_is_restored_once(results):
    copy = copied(results)
    file_times.restore(copy)
    os.utime(copy / ORDER[0], (9, 9))
    file_times.restore(copy)
    assert times(copy) == [9, 2, 3]


def test_what_a_later_run_makes_is_kept_too(results):
    (results / ORDER[1]).write_text("another")
    os.utime(results / ORDER[1], (7, 7))
    file_times.keep(results)
    copy = copied(results)
    file_times.restore(copy)
    assert times(copy) == [1, 7, 3]


@pytest.mark.parametrize("text", ["", "{", "[1]", '{"a": 1}', '{"a": {"time": "x"}}'])
def test_a_damaged_record_restores_nothing_and_is_written_anew(results, text):
    (results / file_times.KEPT).write_text(text)
    file_times.restore(results)
    assert times(results) == [1, 2, 3]
    file_times.keep(results)
    copy = copied(results)
    file_times.restore(copy)
    assert times(copy) == [1, 2, 3]


def test_without_results_nothing_is_written(tmp_path):
    file_times.keep(tmp_path / "results")
    file_times.restore(tmp_path / "results")
    assert not list(tmp_path.iterdir())
