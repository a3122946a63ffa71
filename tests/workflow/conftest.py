"""Copies of a finished quick run and of the project, to change."""

import shutil
from pathlib import Path

import pytest
from helpers import copy_of_sources


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
