"""Missing and extra files, the page, the verdict on the screen, and accepting."""

import json

import made_up_results as made_up
import netCDF4
import pytest
from figure_diff.accept_results import accept_results
from figure_diff.compare_results import compare_results
from figure_diff.tell_faults import tell_faults
from made_up_results import CHAOTIC_PICTURE, NAMES, PICTURE, REGULAR, change_a, regular
from pendula.datasets.netcdf import save
from pendula.figure_diff.baseline import RECORD, accept

EXTRA = "figures/fig9.nc"


def plant_everything(run) -> list[str]:
    """Plant one fault of each kind; return the names that the run should have made."""
    save(run.made / REGULAR, change_a(regular(), 1.01))
    save(run.made / EXTRA, regular())
    (run.made / CHAOTIC_PICTURE).unlink()
    (run.made / PICTURE).write_bytes(b"no picture")
    return [*(name for name in NAMES if name != "figures/fig4.nc"), EXTRA]


def test_missing_and_extra_files_are_named(run):
    lines = run.faults(plant_everything(run))
    assert f"missing: {CHAOTIC_PICTURE}: was not made" in lines
    gone = "is in the baseline, but no longer among the results"
    assert f"missing: figures/fig4.nc: {gone}" in lines
    assert f"extra: {EXTRA}: is not in the baseline" in lines


def test_without_a_baseline_all_is_extra(run, tmp_path):
    empty = run._replace(accepted=tmp_path / "nothing")
    assert [line.split(":")[0] for line in empty.faults()] == ["extra"] * len(NAMES)


@pytest.fixture
def told(run, monkeypatch, capsys):
    """Return a function: compare as the rules do, and return page, verdict, screen, exit code."""
    monkeypatch.chdir(run.made.parent)

    def tell(names):
        results = [f"results/{name}" for name in names]
        compare_results(results, str(run.accepted), "diff/index.html", "diff/verdict.json")
        code = 0
        try:
            tell_faults("diff/verdict.json", "diff/index.html")
        except SystemExit as left:
            code = left.code
        folder = run.made.parent / "diff"
        page, verdict = (folder / "index.html").read_text(), (folder / "verdict.json").read_text()
        return page, json.loads(verdict), capsys.readouterr().out.splitlines(), code

    return tell


def test_a_clean_run_says_so(told):
    page, verdict, screen, code = told(NAMES)
    assert code == 0 and screen == ["6 identical; see diff/index.html"]
    assert "Figure diff: no faults" in page and len(verdict) == 6


def test_faults_are_told_in_one_line_each_and_the_page_is_kept(run, told):
    names = plant_everything(run)
    page, verdict, screen, code = told(names)
    assert code == 1 and len(screen) == 1 + 5 and len(verdict) == 7
    kinds = ["different", "damaged", "missing", "missing", "extra"]
    assert [line.split(":")[0] for line in screen[:-1]] == kinds
    assert "Figure diff: 5 faults" in page
    assert all(name in page for name in [*names, "figures/fig4.nc"])


def test_the_page_shows_three_pictures_side_by_side_and_needs_no_network(run, told):
    made_up.put(run.made, "fig2", regular(), label=" ")
    page, *_ = told(NAMES)
    assert page.count('src="data:image/png;base64,') == 3 + 1  # and a thumbnail of the other
    assert "http" not in page and str(run.made) not in page


def test_accepting_takes_what_changed_and_nothing_else(run, told, monkeypatch, capsys):
    save(run.made / REGULAR, change_a(regular(), 1.01))
    kept = (run.accepted / PICTURE).stat().st_mtime_ns
    accept_results([f"results/{name}" for name in NAMES], str(run.accepted))
    assert capsys.readouterr().out == f"{REGULAR}\n"
    assert (run.accepted / PICTURE).stat().st_mtime_ns == kept
    assert not run.faults()


def test_accepting_removes_what_is_no_longer_made(run):
    changed = accept([name for name in NAMES if name != PICTURE], *run)
    assert changed == [f"{PICTURE} (removed)"] and not (run.accepted / PICTURE).exists()
    record = json.loads((run.accepted / RECORD).read_text())
    assert PICTURE not in record["files"] and "matplotlib" in record["environment"]


def test_accepted_datasets_are_compressed(run):
    """The baseline is committed, and ten times as large without."""
    with netCDF4.Dataset(run.accepted / REGULAR) as data:
        assert data["l2"].filters()["zlib"]
