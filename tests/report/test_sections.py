"""The sections on the ledger, on speed, on how the run was made, and the films."""

import base64

import numpy as np
import pytest
import xarray as xr
from accepted import BASELINE, Report, dataset
from pendula.datasets.json_files import load_json, sealed
from pendula.ledger import section as claims
from pendula.report import sections
from pendula.report.results import ReportError, Results
from pendula.studies.pendula.section import films

ROWS = load_json(BASELINE / "claims.json")["rows"]
MEASURED = sections.Measured("speed/work_precision.nc", "table.md", [], False)


@pytest.fixture
def of_rows(tmp_path):
    """Return a function: the results of a run that has rows of the ledger alone, or changed."""

    def results(*rows):
        (tmp_path / "claims.json").write_text(sealed({"rows": list(rows)}))
        return Results([str(tmp_path / "claims.json")], str(tmp_path / "report.html"))

    return results


def test_each_claim_is_shown_once_and_those_that_are_not_confirmed_in_the_open():
    results = Report()
    found = claims.gather(results, claims.Ledger(results))
    lists = [part for part in found.values() if isinstance(part, claims.Claims)]
    shown = [row["name"] for part in lists for row in part.claims]
    assert sorted(shown) == sorted(row["name"] for row in ROWS)
    opened = {row["verdict"] for part in lists if not part.folded for row in part.claims}
    assert opened == {row["verdict"] for row in ROWS} - {"confirmed", "confirmed with a caveat"}
    (row,) = (row for part in lists for row in part.claims if row["name"] == "hamiltonian")
    assert row["data"][0] == ("results/checks/gradient.nc", "checks/gradient.nc")
    assert row["criterion"].replace("\N{NO-BREAK SPACE}", " ").endswith("energy drift ≤ 10⁻⁷")
    for origin, *counts in found["counts"].rows:
        own = [row["verdict"] for row in ROWS if row["origin"] == origin]
        pairs = zip(found["counts"].head[1:], counts, strict=True)
        assert {verdict: int(count.text) for verdict, count in pairs} == {
            verdict: own.count(verdict) for verdict in found["counts"].head[1:]
        }


def test_claims_on_a_figure_are_those_of_the_paper_alone(of_rows):
    (row,) = (row for row in ROWS if row["name"] == "fig5_decreases")
    own = row | {"name": "own", "place": "Beyond the paper, Fig 5", "origin": "of this project"}
    both = row | {"name": "both", "place": "Section 5, Figs 2 and 5 left"}
    ledger = claims.Ledger(of_rows(row, own, both))
    assert [[one["name"] for one in ledger.on(figure)] for figure in (2, 5, 6)] == [
        ["both"], ["fig5_decreases", "both"], []
    ]  # fmt: skip


def test_numbers_of_the_ledger_link_to_what_decides_them(of_rows):
    ledger = claims.Ledger(Report())
    assert ledger.quote("hamiltonian", "energy_drift") == (
        "9.38\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}10⁻¹⁰",
        "checks/gradient.nc",
    )
    unknown = {**ROWS[0], "measured": {"y": "none"}}
    ledger = claims.Ledger(of_rows(unknown))
    assert np.isnan([ledger.value(unknown["name"], name) for name in "xy"]).all()


def test_times_without_peers_are_shown_and_a_dataset_without_times_is_rejected():
    data = dataset("speed/work_precision").drop_dims("peer")
    found = sections.gather_speed(Report({"speed/work_precision": data}), MEASURED)
    assert found["peers"].rows == [] and "Taylor" in found["fastest"]
    with pytest.raises(ReportError, match=r"work_precision\.nc holds no times"):
        sections.gather_speed(Report({"speed/work_precision": xr.Dataset()}), MEASURED)


def test_run_times_are_read_from_the_last_lines_of_logs(tmp_path):
    (tmp_path / "checks").mkdir()
    (tmp_path / "checks/a.log").write_text("said much\nwall time: 1.5 s, largest memory: 9 MB\n")
    (tmp_path / "b.log").write_text("wall time: 12.0 s, largest memory: 80 MB\n")
    (tmp_path / "old.log").write_text("nothing\n")
    (tmp_path / "empty.log").write_text("")
    assert sections.run_times(tmp_path) == [("b", 12.0, "80"), ("checks/a", 1.5, "9")]
    assert sections.run_times(tmp_path / "absent") == []


def test_hashes_follow_the_content(tmp_path):
    reference, made_by, found = tmp_path / "case.nc", {"run_case": 64 * "a"}, []
    for content in ("a", "b"):
        reference.write_text(content)
        found.append(sections.gather_provenance(made_by, [str(reference)], "{}", tmp_path))
    one, other = (dict(each["hashes"].rows) for each in found)
    assert one["run_case"] == 16 * "a"
    assert {name for name in one if one[name] != other[name]} == {"reference case"}
    assert dict(found[0]["versions"].rows)["numpy"] == np.__version__ and not found[0]["times"].rows


def test_a_film_is_a_byte_for_each_angle():
    results = Report()
    data = results["pendula/film"]
    for case, film in films(results).items():
        angles = data["angle_step"].sel(case=case)
        assert (
            np.frombuffer(base64.b64decode(film.frames), np.int8) == angles.values.ravel()
        ).all()
        assert (film.pictures, film.sites) == (data.sizes["picture"], data.sizes["site"])
        hanging, angle = film.rows[0][2], np.pi / 127 * float(angles[-1, 0, 2])
        assert hanging["x"] - hanging["from"] == pytest.approx(48.0 * np.sin(angle), abs=0.06)
        assert hanging["y"] - hanging["hook"] == pytest.approx(48.0 * np.cos(angle), abs=0.06)
        tau = float(data["tau_of_period"].sel(case=case))
        assert film.step * film.per_period == pytest.approx(tau)
