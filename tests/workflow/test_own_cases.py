"""Cases, sweeps and surveys of one's own by the real snakemake: one page, parts, exact reruns."""

import copy
import re
import shutil

import pytest
import xarray as xr
from helpers import ROOT, planned, snakemake
from html_tags import Tags

SETTINGS = {
    "cases": {
        "fig5": {"omega": 8, "half_width": 6, "end_time": 5},  # a name that a figure has too
        "sea": {"omega": 0, "half_width": 6, "end_time": 30, "initial": {1: [1, "0.1-0.2j"]}},
    },
    "sweeps": {
        "fig5": {"case": "fig5", "half_widths": [2, 4, 6], "windows": [[1, 4]]},
        "mine": {"case": "fig3_small", "half_widths": [0, 2], "windows": [[1, 2]]},  # the paper's
    },
    "surveys": {"map": {"case": "fig3_small", "axes": {"omega": [-5, -4, -3]}, "chunks": 8}},
}
REPORT = "results/own_report.html"


@pytest.fixture(scope="module")
def own_run(made_once):
    def make(folder):
        result = snakemake(ROOT, folder, "own", settings=SETTINGS)
        assert result.returncode == 0, result.stderr

    return made_once("own_run", make)


@pytest.fixture
def finished_run(own_run, tmp_path):
    return shutil.copytree(own_run, tmp_path / "made")


@pytest.fixture
def changed():
    return copy.deepcopy(SETTINGS)


def test_nothing_of_the_paper_is_made(own_run):
    results = {path.stem for path in (own_run / "results/trajectories").iterdir()}
    assert results == {"fig5", "sea"}
    assert not (own_run / "results/figures").exists()


def test_the_page_shows_its_pictures_and_links_to_what_is_there(own_run):
    page = Tags((own_run / REPORT).read_text())
    assert page.faults == [] and len(page.all("img")) == 7
    for picture in page.all("img"):
        assert (own_run / "results" / picture["src"]).exists() and picture["alt"]
    for link in (tag["href"] for tag in page.all("a")):
        inside = link.startswith("#") and link[1:] in page.ids
        assert inside or (own_run / "results" / link).exists(), link


def test_the_page_says_what_the_checks_say(own_run):
    sections = (own_run / REPORT).read_text().split("<section id=")
    text = [re.sub(r"<[^>]+>", "", section) for section in sections]
    still_case, sea = text[1:3]
    assert (
        "to the end, to" in still_case
        and "Theorem 1 covers" in still_case
        and "chaoticno" in still_case
    )
    assert "chaoticyes" in sea and "only Theorem 3 covers" in sea
    with xr.open_dataset(own_run / "results/own/cases/sea.checks.nc") as checks:
        assert f"until τ = {float(checks['divergence_time']):.4g}, within" in sea
    assert not re.findall(r"\bnan\b", "".join(text))


def test_a_new_omega_reruns_its_case_the_sweep_of_that_and_the_report(finished_run, changed):
    changed["cases"]["sea"]["omega"] = 0.5
    changed["cases"]["fig5"]["omega"] = 7.5
    assert planned(ROOT, finished_run, "own", settings=changed) == {
        "trajectory": 2,
        "own_checks": 2,
        "own_norms": 2,
        "own_spacetime": 2,
        "sweep": 1,
        "own_sweep_figure": 1,
        "own_table": 3,
        "own": 1,
    }


def test_a_lost_part_is_made_again_alone(finished_run, changed):
    """A survey has no more chunks than runs, whether or not it gives their number.

    tests/studies/test_parts.py shows that the number of parts changes no bit.
    """
    assert len([*finished_run.glob("results/surveys/map.parts/*-of-3.nc")]) == 3
    for name in ("map.nc", "map.parts/1-of-3.nc"):
        (finished_run / "results/surveys" / name).unlink()
    del changed["surveys"]["map"]["chunks"]
    repeated = planned(ROOT, finished_run, "results/surveys/map.nc", settings=changed)
    assert repeated == {"survey": 2}  # the chunk, and the survey of all chunks


def test_chunks_split_the_runs_of_a_study_into_jobs(tmp_path):
    """The references in multiprecision are made where they are asked for by name."""
    datasets = {"fates": 1, "sensitivity": 1, "unbounded": 10, "fig5_left": 2}
    jobs = planned(ROOT, tmp_path, *datasets, "reference", "--set-scatter", "runs=8")
    rules = {"map_fates", "measure_sensitivity", "spread", "spread_again"}
    rules |= {"run_transverse", "run_noise", "sweep", "sweep_by_second_solver"}
    count = sum(datasets.values())
    assert sum(jobs.get(rule, 0) for rule in rules) == 8 * count + count
    assert jobs["reference_case"] == 6


def test_a_case_that_is_not_even_is_refused_a_proof_before_any_job(tmp_path):
    result = snakemake(ROOT, tmp_path, "-n", "results/certified/sea.nc", settings=SETTINGS)
    assert result.returncode != 0
    assert (
        "cases.sea: a proof requires initial data that are even in n"
        in result.stderr + result.stdout
    )
