"""The sections on speed, hard cases and how the run was made, on made-up results."""

import made_up_report as made_up
import numpy as np
import pytest
import xarray as xr
from pendula.report import sections
from pendula.report.results import ReportError
from pendula.studies.hard_cases import section as hard_cases


def times(taylor: float) -> xr.Dataset:
    """Return least times in s of two solvers that reach the error and of one that does not."""
    names = ["dop853", "taylor", "crank_nicolson"]
    return xr.Dataset(
        {
            "best_seconds": (("case", "solver"), [[6.1e-3, taylor, np.nan]]),
            "target": ("case", [1e-10]),
            "title": ("contestant", [*names, "SciPy RK45", "Octave"]),
            "mean_ratio": ("peer", [924.0, np.nan]),
            "reached_cases": ("peer", [4, 0]),
            "omega": ("case", [8.0]),
            "initial": ("case", [made_up.SMALL]),
        },
        coords={
            "case": ["fig2_small"],
            "solver": names,
            "contestant": [*names, "scipy", "octave"],
            "peer": ["scipy", "octave"],
        },
    )


def gathered(folder, measured: xr.Dataset) -> dict:
    """Return what the section shows of measurements in the dataset speed.nc."""
    results = made_up.MadeUp(folder, {"speed": measured})
    return sections.gather_speed(results, sections.Measured("speed.nc", "table.md", [], False))


@pytest.mark.parametrize(("taylor", "fastest"), [(3.25e-3, "Taylor"), (7.5e-3, "DOP853")])
def test_the_fastest_is_found_at_the_error_asked_for(tmp_path, taylor, fastest):
    found = gathered(tmp_path, times(taylor))
    assert found["fastest"] == fastest and str(found["wins"]) == str(found["cases"]) == "1"
    assert found["head"] == ["case", "error", "DOP853", "Taylor"]
    assert [str(cell) for cell in found["rows"][0][1:]] == ["10⁻¹⁰", "6.1", f"{1e3 * taylor:g}"]
    assert [[name, str(ratio)] for name, ratio in found["peers"]] == [
        ["SciPy RK45", "924 (4 cases)"]
    ]
    assert found["absent"] == ["Octave"] and found["table"] == "table.md"


def test_times_without_peers_are_shown(tmp_path):
    found = gathered(tmp_path, times(3e-3).drop_dims("peer"))
    assert found["peers"] == found["absent"] == [] and found["fastest"] == "Taylor"


def test_a_dataset_without_times_is_refused(tmp_path):
    with pytest.raises(ReportError, match=r"speed\.nc holds no times"):
        gathered(tmp_path, xr.Dataset())


def hard(sound: int) -> xr.Dataset:
    columns = {
        "case": ["amplitudes of 1e-20", "amplitudes of 1e-170", "gamma = 1"],
        "solver": ["taylor: rtol 1e-12", "taylor: rtol 1e-12", "dop853: rtol 1e-12"],
        "error": [1e-12, np.nan, 2e-10],
        "limit": [1e-9, np.nan, 1e-9],
        "refusal": ["", "squares vanish", ""],
        "reference": ["exact", "exact", "exact"],
        "sound": [1, 1, sound],
    }
    return xr.Dataset({name: ("row", values) for name, values in columns.items()})


def test_hard_cases_are_counted(tmp_path):
    found = hard_cases.gather(made_up.MadeUp(tmp_path, {"checks/hard_cases": hard(0)}), None)
    assert [str(found[name]) for name in ("runs", "refused", "unexpected")] == ["3", "1", "1"]
    assert not found["sound"]
    taylor, dop853 = found["by_solver"]
    assert [str(cell) for cell in taylor] == ["Taylor", "2", "1", "0.001", "0"]
    assert [str(cell) for cell in dop853][3:] == ["0.2", "1"]
    assert found["rows"][1][2] == "refused: squares vanish"


def test_sound_hard_cases_are_told_so(tmp_path):
    results = made_up.MadeUp(tmp_path, {"checks/hard_cases": hard(1)})
    assert hard_cases.gather(results, None)["sound"]


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
