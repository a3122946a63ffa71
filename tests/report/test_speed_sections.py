"""The sections on speed and on how the run was made."""

import numpy as np
import pytest
import xarray as xr
from accepted import Report, dataset
from pendula.report import sections
from pendula.report.results import ReportError

MEASURED = sections.Measured("speed/work_precision.nc", "table.md", [], False)


def test_times_without_peers_are_shown():
    data = dataset("speed/work_precision").drop_dims("peer")
    found = sections.gather_speed(Report({"speed/work_precision": data}), MEASURED)
    assert found["peers"] == found["absent"] == [] and found["fastest"] == "Taylor"


def test_a_dataset_without_times_is_refused():
    with pytest.raises(ReportError, match=r"work_precision\.nc holds no times"):
        sections.gather_speed(Report({"speed/work_precision": xr.Dataset()}), MEASURED)


def test_run_times_are_read_from_the_last_lines_of_logs(tmp_path):
    (tmp_path / "checks").mkdir()
    (tmp_path / "checks/a.log").write_text("said much\nwall time: 1.5 s\n")
    (tmp_path / "b.log").write_text("wall time: 12.0 s\n")
    (tmp_path / "old.log").write_text("nothing\n")
    (tmp_path / "empty.log").write_text("")
    assert sections.run_times(tmp_path) == [("b", 12.0), ("checks/a", 1.5)]
    assert sections.run_times(tmp_path / "absent") == []


def test_hashes_follow_the_content(tmp_path):
    reference, made_by = tmp_path / "case.nc", {"run_case": 64 * "a"}
    found = []
    for content in ("a", "b"):
        reference.write_text(content)
        found.append(sections.gather_provenance(made_by, [str(reference)], "{}", tmp_path))
    one, other = found
    assert one["hashes"][0] == other["hashes"][0] == ("run_case", 16 * "a")
    assert one["hashes"][1][0] == "reference case" and one["hashes"][1] != other["hashes"][1]
    assert dict(one["versions"])["numpy"] == np.__version__ and one["times"] == []
