"""Bad input by the real snakemake: a sentence, a non-zero exit, and no line of the rules.

The sentences are those of tests/configuration/bad_input.yaml. Here stands what Snakemake adds.
"""

import subprocess

import pytest
from helpers import NOISE, ROOT, snakemake, snakemake_with
from look_first import look


def refused(result: subprocess.CompletedProcess) -> str:
    """Return what stands on the screen of a run that must have been refused."""
    said = result.stdout + result.stderr
    assert result.returncode == 1
    assert not [word for word in NOISE if word in said], said
    return said


def test_own_without_a_case_is_told(tmp_path):
    settings = {"limits": {"hours": 2}}
    said = refused(snakemake_with(settings, ROOT, tmp_path, "own"))
    assert "the configuration has no case and no sweep of your own: give some by --config" in said


def test_a_baseline_is_named_by_config_alone_and_is_a_folder(tmp_path):
    """A file that named one would send what is accepted elsewhere, unseen."""
    said = refused(snakemake_with({"baseline": "elsewhere"}, ROOT, tmp_path, "accept_figures"))
    assert "baseline: is not a known key" in said
    said = refused(snakemake(ROOT, tmp_path, "figure_diff", "--config", "baseline=7"))
    assert "--config baseline=7: give the path of a folder" in said


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["--configfile", "none.yaml", "own"],
            ["there is no file none.yaml", "snakemake own --con"],
        ),
        (["--configfiles=none.yaml"], ["there is no file none.yaml"]),
        (["--config", "accept=fig3", "fig3"], ["--config takes name=value", "and 'fig3' is none"]),
        (["-C", "x"], ["and 'x' is none"]),
        (["-C", "cases.mine.omega=3"], ["given as cases='{mine: {omega: 3}}'"]),
        (["--configfile", str(ROOT)], [f"--configfile {ROOT}: this is a folder: name a file"]),
        (["--configfile", "/dev/null"], ["/dev/null: this is no regular file, and it must"]),
        (["--directory", __file__, "own"], [f"--directory {__file__}: {__file__} is no folder"]),
        ([f"--directory={__file__}/a/b", "own"], [f"/a/b: {__file__} is no folder, and results"]),
        (["-d", "/dev/null"], ["/dev/null is no folder, and results need one: name another"]),
        (["--config", "limits={hours: 1, hours: 2}"], ["line 1: hours: the key stands twice"]),
    ],
)
def test_an_option_that_takes_a_target_for_its_own_says_so(arguments, words, capsys):
    with pytest.raises(SystemExit) as ended:
        look(arguments)
    said = capsys.readouterr().err
    assert ended.value.code == 1 and all(part in said for part in words)


def test_what_is_right_is_let_pass(tmp_path):
    (tmp_path / "mine.yaml").write_text("cases: {mine: {omega: 8}}")
    look(["own", "--cores", "2", "--configfile", str(tmp_path / "mine.yaml"), "-C", "bits=any"])
    look(["--directory", str(tmp_path / "not/yet"), __file__])


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("cases: {mine: {omega: 8}}".encode("utf-16"), "is not a text in UTF-8"),
        (b"cases: {mine: {omega: 2001-13-45}}", "2001-13-45 is not a date that can"),
    ],
)
def test_what_snakemake_could_not_read_is_told(content, words, tmp_path, capsys):
    (tmp_path / "mine.yaml").write_bytes(content)
    with pytest.raises(SystemExit):
        look(["own", "--configfile", str(tmp_path / "mine.yaml")])
    assert words in capsys.readouterr().err


def test_it_is_told_before_snakemake_reads(tmp_path):
    """It ends in a traceback where a file that it is to read is missing."""
    said = refused(snakemake(ROOT, tmp_path, "--configfile", "own"))
    assert "targets stand before it: snakemake own --con" in said


def test_a_long_run_says_first_what_it_takes(tmp_path):
    settings = {"cases": {"mine": {"omega": 1e5, "end_time": 800}}}
    target = "results/trajectories/mine.nc"
    result = snakemake_with(settings, ROOT, tmp_path, "--dry-run", target)
    assert result.returncode == 0
    said = result.stdout + result.stderr
    assert said.index("cases.mine: the run and its checks take about") < said.index("Building DAG")
