"""Missing and extra files, the page, and the verdict on the screen."""

from pathlib import Path

import made_up_results as made_up
import pytest
from figure_diff.compare_results import compare_results
from made_up_results import CHAOTIC_PICTURE, NAMES, PICTURE, REGULAR, change_a, regular
from pendula.datasets.netcdf import save
from pendula.figure_diff.baseline import compare
from pendula.figure_diff.comparison_page import load

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
def told(run, monkeypatch):
    """Return a function: compare as the rules do, and return the page and the verdict."""
    monkeypatch.chdir(run.made.parent)

    def tell(names, any_bits=True):
        results = [f"results/{name}" for name in names]
        files = {"html": "diff/index.html", "verdict": "diff/verdict.json"}
        given = results, str(run.accepted), made_up.CONFIGURATION
        compare_results(*given, **files, any_bits=any_bits)
        return Path(files["html"]).read_text(), load(files["verdict"])

    return tell


def test_a_clean_run_says_so(told):
    page, verdict = told(NAMES, any_bits=False)
    assert not verdict.failed and verdict.lines == [
        "The environment is the accepted one, so every file must have the accepted bits.",
        f"{len(NAMES)} identical",
    ]
    assert "Figure diff: no faults" in page and verdict.lines[0] in page


def test_faults_are_told_in_one_line_each_and_the_page_is_kept(run, told):
    names = plant_everything(run)
    page, verdict = told(names)
    assert verdict.failed and len(verdict.findings) == len(NAMES) + 1
    kinds = ["different", "damaged", "missing", "missing", "extra"]
    assert [line.split(":")[0] for line in verdict.lines[:-2]] == kinds
    assert "Figure diff: 5 faults" in page
    assert all(name in page for name in [*names, "figures/fig4.nc"])


def test_what_is_nearly_the_same_is_told_with_the_reason_and_fails_nothing(run, told):
    save(run.made / REGULAR, change_a(regular(), 1 + 1e-7))
    page, verdict = told(NAMES)
    nearly, judged, tally = verdict.lines
    assert not verdict.failed and "bits=any asks for it" in judged
    assert nearly.startswith(f"nearly the same: {REGULAR}: other bits in l2: l2 component=A")
    assert tally == f"1 nearly the same, {len(NAMES) - 1} identical"
    assert "other bits in l2: l2 component=A" in page


def test_a_run_of_another_configuration_is_told_by_what_is_other(run):
    shorter = {"cases": {"fig2_small": {"end_time": 4, "omega": 8}}}
    found = compare(NAMES, *run, shorter).findings
    (fault,) = [each for each in found if each.is_fault]
    assert fault.line == (
        "different: configuration: is not the accepted one: "
        "cases.fig2_small.end_time is 4 in place of 50"
    )


def test_the_page_shows_three_pictures_side_by_side_and_needs_no_network(run, told):
    made_up.put(run.made, "fig2", regular(), label=" ")
    page, _ = told(NAMES)
    assert page.count('src="data:image/png;base64,') == 3
    assert "http" not in page and str(run.made) not in page
