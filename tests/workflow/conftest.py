"""One finished quick run, and copies of the project to change."""

import fcntl
import os
import shutil
from pathlib import Path

import pytest
from helpers import ROOT, snakemake

PARTS = (
    *("Snakefile", "workflow", "scripts", "config", "profiles", "environment.txt"),
    "tests/baseline/reference",
)


@pytest.fixture(scope="session")
def full_run(tmp_path_factory) -> Path:
    """Return a folder with the results of a full run of config/quick.yaml, one for all workers."""
    parallel = "PYTEST_XDIST_WORKER" in os.environ
    base = tmp_path_factory.getbasetemp()
    directory = (base.parent if parallel else base) / "full_run"
    directory.mkdir(exist_ok=True)
    with open(directory / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (directory / "results/claims.json").exists():
            result = snakemake(ROOT, directory)
            assert result.returncode == 0, result.stdout + result.stderr
    return directory


@pytest.fixture
def finished(full_run, tmp_path) -> Path:
    """Return a copy of that folder, times and Snakemake's own records included, to be changed."""
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
