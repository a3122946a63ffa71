"""The rule `report` by the real snakemake: what reruns it, and what it says then."""

import os
import re

import xarray as xr
from helpers import planned, snakemake


def page_of(project) -> str:
    return (project / "results/report.html").read_text(encoding="utf-8")


def without_times(page: str) -> str:
    """Return the page without its run times, the only part that differs between two runs."""
    return re.sub(r"<summary>Wall times.*?</section>", "", page, flags=re.DOTALL)


def put_measurements(clone, finished) -> None:
    """Put what the project keeps of its speed where this machine's own would stand."""
    kept = clone / "tests/baseline/speed"
    names = ("speed_regular", "speed_large", "speed_unstable", "cost_growth")
    here = {f"figures/{name}.png": kept / "speed_regular.png" for name in names}
    for kind in ("nc", "md"):
        here[f"speed/work_precision.{kind}"] = kept / f"work_precision.{kind}"
    for name, source in here.items():
        target = finished / "results" / name
        target.parent.mkdir(exist_ok=True)
        target.write_bytes(source.read_bytes())


def test_two_runs_give_the_same_page_but_for_the_times(finished, clone):
    before = page_of(finished)
    assert snakemake(clone, finished, "report", "--forcerun", "report").returncode == 0
    assert without_times(page_of(finished)) == without_times(before) != before


def test_a_template_and_measurements_of_this_machine_rerun_pages_alone(finished, clone):
    """No measurement of speed is started."""
    path = clone / "scripts/pendula/report/page/templates/report.html.j2"
    path.write_text(path.read_text() + "\n")
    assert set(planned(clone, finished)) == {"report", "live", "article", "all"}
    path.write_text(path.read_text()[:-1])
    put_measurements(clone, finished)
    assert set(planned(clone, finished)) == {"report", "all"}


def test_another_dataset_and_measurements_of_this_machine_make_another_page(finished, clone):
    put_measurements(clone, finished)
    path = finished / "results/checks/solvers.nc"
    data = xr.load_dataset(path)
    data["largest_drift"] = data["largest_drift"] * 0 + 0.0735
    made = path.stat().st_mtime_ns
    data.to_netcdf(path)
    os.utime(path, ns=(made, made))  # only the report is made anew, and no claim
    before = re.sub("<[^>]*>", " ", page_of(finished))
    assert "0.073" not in before and "kept by the project" in before
    assert snakemake(clone, finished, "report", "--forcerun", "report").returncode == 0
    after = re.sub("<[^>]*>", " ", page_of(finished))
    assert "0.073" in after and "kept by the project" not in after
