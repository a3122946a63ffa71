"""Copies of a finished quick run and of the project, to change."""

import shutil
from pathlib import Path

import pytest
from helpers import ROOT, copy_of_sources, snakemake


@pytest.fixture
def finished(full_run, tmp_path) -> Path:
    """Return a copy of the finished run, with its times and Snakemake's records, to be changed."""
    left = shutil.ignore_patterns("archive")  # which is larger than all the rest
    return shutil.copytree(full_run, tmp_path / "finished", ignore=left)


@pytest.fixture
def clone(tmp_path) -> Path:
    """Return a fresh copy of the project's sources, newer than any result."""
    return copy_of_sources(tmp_path / "clone")


@pytest.fixture(scope="session")
def looked(made_once) -> Path:
    """Return what a dry run says in an empty folder: dry_run.txt; the folder is beside it."""

    def make(beside):
        (beside / "folder").mkdir()
        result = snakemake(ROOT, beside / "folder", "--dry-run")
        assert result.returncode == 0, result.stderr
        (beside / "dry_run.txt").write_text(result.stdout + result.stderr)

    return made_once("looked", make)
