"""Copies of a finished quick run and of the project, to change."""

import shutil
from pathlib import Path

import pytest
from helpers import ROOT, copy_of_sources, jobs_in, snakemake


@pytest.fixture
def finished(full_run, tmp_path) -> Path:
    """Return a copy of the finished run, with its times and Snakemake's records, to be changed."""
    return shutil.copytree(full_run, tmp_path / "finished")


@pytest.fixture
def clone(tmp_path) -> Path:
    """Return a fresh copy of the project's sources, newer than any result."""
    return copy_of_sources(tmp_path / "clone")


@pytest.fixture
def accepted(accepted_once, tmp_path) -> tuple[Path, Path]:
    """Return copies of that finished run and of that clone, to be changed."""
    folder = shutil.copytree(accepted_once, tmp_path / "accepted")
    return folder / "finished", folder / "clone"


@pytest.fixture(scope="session")
def looked(made_once) -> Path:
    """Return what a dry run and a list of targets say in an empty folder: dry_run.txt, list.txt.

    The folder itself is beside them: folder.
    """

    def make(beside):
        (beside / "folder").mkdir()
        for name, option in (("dry_run", "--dry-run"), ("list", "--list")):
            result = snakemake(ROOT, beside / "folder", option)
            assert result.returncode == 0, result.stderr
            said = result.stdout if name == "list" else result.stdout + result.stderr
            (beside / f"{name}.txt").write_text(said)

    return made_once("looked", make)


@pytest.fixture(scope="session")
def first_plan(looked) -> dict[str, int]:
    """Return the number of jobs of each rule that a first run has."""
    return jobs_in((looked / "dry_run.txt").read_text())
