"""What the benchmark of a whole run reads from the logs of jobs, and how it starts a run."""

import json
import subprocess

import pytest

from benchmarks import reproduction

DRAWN = {"start-up": 0.03, "compiling": 0.0, "drawing": 1.5, "writing": 0.1, "computing": 0.37}


def write_logs(folder):
    (folder / "figures").mkdir(parents=True)
    told = f"drawn\nspent: {json.dumps({**DRAWN, 'memory': 250})}\nwall time: 4.0 s\n"
    (folder / "figures/fig5.log").write_text(told)
    (folder / "imports.log").write_text('a warning\nspent: {"imports": 2.0, "memory": 270}\n')
    (folder / "killed.log").write_text("half of a")


def test_jobs_are_read_from_their_logs(tmp_path):
    write_logs(tmp_path / "logs")
    jobs = reproduction.jobs_of(tmp_path / "logs")
    assert jobs.keys() == {"figures/fig5", "imports"}
    assert jobs["figures/fig5"] == {**DRAWN, "memory": 250, "wall": 4.0}
    assert reproduction.spent(jobs["figures/fig5"]) == pytest.approx(2.0)


def test_a_run_finds_no_kernels_but_its_own(tmp_path, monkeypatch):
    started = {}

    def run(command, **options):
        started.update(options)
        return subprocess.CompletedProcess(command, 0, "", "")

    monkeypatch.setenv("PENDULA_CACHE", "/elsewhere")
    monkeypatch.setattr(subprocess, "run", run)
    measured = reproduction.run(tmp_path / "project")
    assert measured["wall"] >= 0.0 and measured["processor"] == 0.0
    assert started["cwd"] == tmp_path / "project"
    assert started["env"]["PENDULA_CACHE"] == str(tmp_path / "kernels")


def test_a_run_that_fails_says_what_it_said(tmp_path, monkeypatch, capsys):
    failed = subprocess.CompletedProcess([], 1, "half of a run", "no such letter")
    monkeypatch.setattr(subprocess, "run", lambda command, **options: failed)
    with pytest.raises(subprocess.CalledProcessError):
        reproduction.run(tmp_path / "project")
    assert capsys.readouterr().err == "half of a run\nno such letter\n"


def test_three_runs_are_told_and_what_no_job_took_is_that_of_snakemake(
    tmp_path, monkeypatch, capsys
):
    def run(project):
        (project / ".snakemake").mkdir(parents=True, exist_ok=True)
        if not (project / "results").exists():
            write_logs(project / "results/logs")
        return {"wall": 7.0, "processor": 9.0}

    monkeypatch.setattr(reproduction.shutil, "copytree", lambda *_, **__: None)
    monkeypatch.setattr(reproduction, "run", run)
    reproduction.main(tmp_path / "data.json")
    said = capsys.readouterr().out
    assert said.count("| 7.0 | 9.0 |") == 3
    assert said.count("| Snakemake | 5.00 |") == 2
    assert said.count("| figures/fig5 | 0.03 |  |  | 0.37 | 1.50 | 0.10 | 2.00 | 250 |") == 2
    kept = json.loads((tmp_path / "data.json").read_text())
    assert kept["runs"]["warm"]["jobs"]["figures/fig5"]["drawing"] == 1.5
    assert kept["runs"]["nothing"]["jobs"] == {} and kept["machine"]["cores"] > 0
