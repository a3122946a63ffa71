"""How the benchmark of a whole run starts it."""

import subprocess

import pytest

from benchmarks import reproduction


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
