"""The rule `report` by the real snakemake: what reruns it, and what it says then."""

import re

import xarray as xr
from helpers import planned, snakemake

FOLDER = "scripts/pendula"


def page_of(project) -> str:
    return (project / "results/report.html").read_text(encoding="utf-8")


def without_times(page: str) -> str:
    """Return the page without its run times, the only part that differs between two runs."""
    return re.sub(r'<div id="times">.*?</div>\s*</section>', "", page, flags=re.DOTALL)


def test_a_template_the_style_or_the_script_reruns_the_report_alone(finished, clone):
    folder = "report/page"
    of_page = ("templates/base.html.j2", "style.css", "script.js")
    for name in ("studies/chaos/section.html.j2", *(f"{folder}/{name}" for name in of_page)):
        path = clone / FOLDER / name
        text = path.read_text()
        path.write_text(text + "\n")
        assert set(planned(clone, finished)) == {"report", "all"}, name
        path.write_text(text)
    assert planned(clone, finished) == {}


def test_two_runs_give_the_same_page_but_for_the_times(finished, clone):
    before = page_of(finished)
    assert snakemake(clone, finished, "report", "--forcerun", "report").returncode == 0
    assert without_times(page_of(finished)) == without_times(before) != before


def test_another_dataset_makes_another_page(finished, clone):
    path = finished / "results/checks/solvers.nc"
    data = xr.load_dataset(path)
    data["largest_drift"] = data["largest_drift"] * 0 + 0.0735
    data.to_netcdf(path)
    assert "0.073" not in re.sub("<[^>]*>", " ", page_of(finished))
    assert snakemake(clone, finished, "report").returncode == 0
    assert "0.073" in re.sub("<[^>]*>", " ", page_of(finished))


def test_nothing_is_read_back_from_what_a_figure_shows(finished, clone):
    """What is published is computed in a study and kept in a dataset of its own."""
    drawn = list((finished / "results/figures").glob("*.nc"))
    for path in drawn:
        path.touch()
    assert len(drawn) > 15 and planned(clone, finished) == {}


def test_measurements_of_this_machine_are_preferred_and_start_no_timing(finished, clone):
    assert "that the project keeps" in page_of(finished)
    kept = clone / "tests/baseline/speed"
    names = ("speed_regular", "speed_large", "speed_unstable", "cost_growth")
    here = {f"figures/{name}.png": kept / "speed_regular.png" for name in names}
    for kind in ("nc", "md"):
        here[f"speed/work_precision.{kind}"] = kept / f"work_precision.{kind}"
    for name, source in here.items():
        target = finished / "results" / name
        target.parent.mkdir(exist_ok=True)
        target.write_bytes(source.read_bytes())
    assert set(planned(clone, finished)) == {"report", "all"}
    assert snakemake(clone, finished, "report").returncode == 0
    assert "that the project keeps" not in page_of(finished)
