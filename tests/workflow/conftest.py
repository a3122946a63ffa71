"""Copies of a finished quick run and of the project, to change."""

import shutil
from pathlib import Path

import pytest
from helpers import ROOT

PARTS = (
    *("Snakefile", "workflow", "scripts", "benchmarks", "config", "profiles", "environment.txt"),
    *("tests/baseline/reference", "tests/baseline/speed", "tests/baseline/tolerances.yaml"),
    "tests/baseline/spreads.nc",
)


@pytest.fixture
def finished(full_run, tmp_path) -> Path:
    """Return a copy of the finished run, with its times and Snakemake's records, to be changed."""
    return shutil.copytree(full_run, tmp_path / "finished")


@pytest.fixture
def clone(tmp_path) -> Path:
    """Return a fresh copy of the project's sources, newer than any result."""
    project = tmp_path / "clone"
    for part in PARTS:
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(
                source,
                project / part,
                ignore=shutil.ignore_patterns("__pycache__"),
                copy_function=shutil.copy,
            )
        else:
            project.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, project / part)
    return project
