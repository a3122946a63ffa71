"""The rule `report` by the real snakemake: what reruns it, and whose measurements it shows."""

import pytest
from accepted import Report
from helpers import planned
from pendula.report.sections import Measured, gather_speed


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


def test_a_template_and_measurements_of_this_machine_rerun_pages_alone(finished, clone):
    """No measurement of speed is started."""
    path = clone / "scripts/pendula/report/page/templates/report.html.j2"
    path.write_text(path.read_text() + "\n")
    pages = {"report", "live", "article", "all"}
    # both tables are written by modules that write a part of the report too
    assert set(planned(clone, finished)) == pages | {"solver_table", "hard_cases_table"}
    path.write_text(path.read_text()[:-1])
    put_measurements(clone, finished)
    assert set(planned(clone, finished)) == {"report", "all"}


@pytest.mark.parametrize(
    ("fresh", "whose"), [(False, "kept by the project"), (True, "measured by snakemake speed")]
)
def test_the_page_says_who_measured_the_speed(fresh, whose):
    measured = Measured("speed/work_precision.nc", "table.md", [], fresh)
    assert whose in gather_speed(Report(), measured)["least"].title
