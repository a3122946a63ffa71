"""Copies of a finished quick run and of the project, to change."""

import shutil
from pathlib import Path

import pytest
from helpers import ROOT, copy_of_sources, snakemake


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
    """Return what a dry run says in an empty folder: dry_run.txt; the folder is beside it."""

    def make(beside):
        (beside / "folder").mkdir()
        result = snakemake(ROOT, beside / "folder", "--dry-run")
        assert result.returncode == 0, result.stderr
        (beside / "dry_run.txt").write_text(result.stdout + result.stderr)

    return made_once("looked", make)
