"""--config chunks= splits many runs into jobs: studies of the paper, and surveys of one's own."""

from helpers import ROOT, planned, snakemake

SENSITIVITY = {"sizes": [1.0e-3, 1.0e-1], "members": 2, "end_time": 5}
SETTINGS = {"breathers": {"sensitivity": SENSITIVITY}}
MADE = "results/breathers/sensitivity.nc"
SURVEY = {"case": "fig3_small", "axes": {"omega": [-5, -4, -3]}}


def test_chunks_split_the_runs_of_a_study_into_jobs(tmp_path):
    datasets = {"fates": 1, "sensitivity": 1, "unbounded": 5, "fig5_left": 2}
    jobs = planned(ROOT, tmp_path, *datasets, "--config", "chunks=8")
    assert jobs["part"] == 8 * sum(datasets.values())


def test_a_survey_of_ones_own_has_no_more_parts_than_runs(tmp_path):
    given = {"surveys": {"mine": SURVEY}}
    split = planned(ROOT, tmp_path, "own", "--config", "chunks=8", settings=given)
    assert split["part"] == 3
    assert planned(ROOT, tmp_path, "own", "--cores", "2", settings=given)["part"] == 2


def test_a_lost_part_is_made_again_alone(tmp_path):
    """tests/studies/test_parts.py shows that the number of parts changes no bit."""
    result = snakemake(ROOT, tmp_path, MADE, "--config", "chunks=3", settings=SETTINGS)
    assert result.returncode == 0, result.stderr
    assert planned(ROOT, tmp_path, MADE, settings=SETTINGS) == {}  # as many parts as are there
    (tmp_path / MADE).unlink()
    (tmp_path / "results/breathers/sensitivity.parts/0-of-3.nc").unlink()
    again = planned(ROOT, tmp_path, MADE, settings=SETTINGS)
    assert again == {"part": 1, "measure_sensitivity": 1}
