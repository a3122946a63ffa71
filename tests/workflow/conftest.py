"""Copies of a finished quick run and of the project, to change."""

import shutil
from pathlib import Path

import pytest
from helpers import ROOT, snakemake

PARTS = (
    *("Snakefile", "workflow", "scripts", "benchmarks", "config", "profiles", "environment.txt"),
    *("tests/baseline/reference", "tests/baseline/proofs", "tests/baseline/speed"),
    *("tests/baseline/tolerances.yaml", "tests/baseline/spreads.nc"),
)


@pytest.fixture
def finished(full_run, tmp_path) -> Path:
    """Return a copy of the finished run, with its times and Snakemake's records, to be changed."""
    return shutil.copytree(full_run, tmp_path / "finished")


@pytest.fixture
def clone(tmp_path) -> Path:
    """Return a fresh copy of the project's sources, newer than any result."""
    return copy_of_sources(tmp_path / "clone")


@pytest.fixture(scope="session")
def accepted_once(full_run, made_once) -> Path:
    """Return a folder with a clone and a finished run that is its baseline, not to be changed."""

    def make(folder):
        finished = shutil.copytree(full_run, folder / "finished")
        result = snakemake(copy_of_sources(folder / "clone"), finished, "accept_figures")
        assert result.returncode == 0, result.stdout + result.stderr

    return made_once("accepted", make)


@pytest.fixture
def accepted(accepted_once, tmp_path) -> tuple[Path, Path]:
    """Return copies of that finished run and of that clone, to be changed."""
    folder = shutil.copytree(accepted_once, tmp_path / "accepted")
    return folder / "finished", folder / "clone"


def copy_of_sources(project: Path) -> Path:
    """Make a fresh copy of the project's sources, and return it."""
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
