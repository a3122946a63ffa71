"""Copies of a finished quick run and of the project, to change."""

import shutil
from pathlib import Path

import pytest
from helpers import ROOT

SOURCES = (
    "Snakefile",
    "workflow",
    "packages/latticode",
    "scripts",
    "benchmarks",
    "config",
    "profiles",
    "environment.txt",
    *(f"tests/baseline/{folder}" for folder in ("reference", "proofs", "speed", "quoted")),
)
"""What of the project a run needs."""


@pytest.fixture
def finished(full_run, tmp_path) -> Path:
    """Return a copy of the finished run, with its times and Snakemake's records, to be changed."""
    left = shutil.ignore_patterns("archive")  # which is larger than all the rest
    return shutil.copytree(full_run, tmp_path / "finished", ignore=left)


@pytest.fixture
def clone(tmp_path) -> Path:
    """Return a fresh copy of the project's sources, newer than any result."""
    left = shutil.ignore_patterns("__pycache__")
    for place in SOURCES:
        (copy := tmp_path / "clone" / place).parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / place).is_dir():
            shutil.copytree(ROOT / place, copy, ignore=left, copy_function=shutil.copy)
        else:
            shutil.copy(ROOT / place, copy)
    return tmp_path / "clone"
