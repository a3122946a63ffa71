"""Another paper uses the general rooms: claims with controls, report, baseline, figure diff."""

import json
import subprocess
import sys

import fput
import pytest
from helpers import python_path


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return the folder of a run, the names of its files, and the accepted copy."""
    folder = tmp_path_factory.mktemp("fput")
    names = fput.make_run(folder / "results")
    fput.accept(names, folder / "results", folder / "baseline")
    return folder / "results", names, folder / "baseline"


def test_the_claims_of_1955_hold_and_their_wrong_cases_are_rejected(run):
    rows = json.loads((run[0] / "claims.json").read_text())["rows"]
    assert {row["name"]: row["verdict"] for row in rows} == {
        "energy_returns": "confirmed",
        "low_modes_hold_the_energy": "confirmed",
    }
    assert all(control["passes"] for row in rows for control in row["controls"])
    measured = {name: value for row in rows for name, value in row["measured"].items()}
    assert measured["returned"] > 0.97  # "to within a few percent", as the paper says


def test_the_report_shows_the_figure_and_both_claims(run):
    page = (run[0] / "report.html").read_text()
    assert "Studies of nonlinear problems" in page and "Fig 1" in page
    assert page.count('class="claim"') == 2


def test_the_run_is_the_accepted_one_and_a_stronger_spring_is_found_in_all_that_shows_it(
    run, tmp_path
):
    results, names, accepted = run
    assert fput.compare(names, results, accepted).faults == 0
    fput.make_run(tmp_path / "other", alpha=0.3)
    comparison = fput.compare(names, tmp_path / "other", accepted)
    different = {result.name for result in comparison.findings if result.status.is_fault}
    assert {"runs/nonlinear.nc", "figures/fig1.png", "figures/fig1.json"} <= different
    assert "runs/linear.nc" not in different


def test_another_paper_loads_nothing_of_this_one():
    code = "import fput, sys; print([name for name in sys.modules if name.startswith('pendula')])"
    path = f"{python_path()}:{fput.__file__.rpartition('/')[0]}"
    command = [sys.executable, "-c", code]
    process = subprocess.run(command, env={"PYTHONPATH": path}, capture_output=True, text=True)
    assert process.stdout.strip() == "[]", process.stderr
