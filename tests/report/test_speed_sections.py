"""The sections on speed and on how the run was made."""

import numpy as np
import pytest
import xarray as xr
from accepted import Report, dataset
from pendula.report import sections
from pendula.report.results import ReportError, Results

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
    assert sections.run_times(tmp_path, "wall time: ") == [("b", 12.0), ("checks/a", 1.5)]
    assert sections.run_times(tmp_path / "absent", "wall time: ") == []


def test_hashes_follow_the_content(tmp_path):
    file, page = tmp_path / "code.txt", str(tmp_path / "page.html")
    made = {"inputs": ["code.txt"], "settings": "{}", "logs": str(tmp_path), "took": "t"}
    found = []
    for text in "ab":
        file.write_text(text)
        found.append(sections.gather_provenance(Results([str(file)], page), **made))
    one, other = found
    assert one["hashes"] != other["hashes"] and one["settings"] == other["settings"]
    assert one["hashes"][0][0].link == "code.txt" and len(one["hashes"][0][1]) == 16
    assert dict(one["versions"])["numpy"] == np.__version__ and one["times"] == []
