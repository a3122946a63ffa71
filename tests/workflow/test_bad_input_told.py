"""Bad input by the real snakemake: a sentence, a non-zero exit, and no line of the rules.

The sentences are those of tests/configuration/bad_input.yaml. Here stands what Snakemake adds.
"""

import subprocess

from helpers import ROOT, snakemake

NOISE = ("Traceback", "common.smk", 'File "', "WorkflowError", "Exception")
"""What of Snakemake's words tells a person nothing."""


def refused(result: subprocess.CompletedProcess) -> str:
    """Return what stands on the screen of a run that must have been refused."""
    output = result.stdout + result.stderr
    assert result.returncode == 1
    assert not [word for word in NOISE if word in output], output
    return output


def test_a_bad_configuration_stops_before_any_job(tmp_path):
    settings = {"cases": {"mine": {"omgea": 3, "half_width": -2, "solver": "dop835"}}, "swepes": {}}
    output = refused(snakemake(ROOT, tmp_path, settings=settings))
    for name in (
        "the configuration has 5 errors:\n  ",
        "cases.mine.omega: is missing",
        "cases.mine.omgea: is not a known key; did you mean 'omega'?",
        "cases.mine.half_width: is -2; it must be at least 0",
        "did you mean 'dop853'?",
        "swepes: is not a known key; did you mean 'sweeps'?",
    ):
        assert name in output
    assert not (tmp_path / "results/trajectories").exists()


def test_a_baseline_is_named_by_config_alone_and_is_a_folder(tmp_path):
    """A file that named one would send what is accepted elsewhere, unseen."""
    output = refused(
        snakemake(ROOT, tmp_path, "accept_figures", settings={"baseline": "elsewhere"})
    )
    assert "baseline: is not a known key" in output
    output = refused(snakemake(ROOT, tmp_path, "figure_diff", "--config", "baseline=7"))
    assert "--config baseline=7: give the path of a folder" in output


def test_a_long_run_says_first_what_it_takes(tmp_path):
    settings = {"cases": {"mine": {"omega": 1e5, "end_time": 800}}}
    target = "results/trajectories/mine.nc"
    result = snakemake(ROOT, tmp_path, "--dry-run", target, settings=settings)
    assert result.returncode == 0
    output = result.stdout + result.stderr
    assert output.index("cases.mine: the run and its checks take about") < output.index(
        "Building DAG"
    )
