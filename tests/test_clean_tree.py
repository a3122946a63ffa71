"""Tests leave nothing in the project's folder, and what git tracks at its top is a short list."""

import os
import subprocess
import sys

import pytest
from helpers import ROOT, skip

TOP = {
    ".dockerignore",
    ".gitignore",
    ".snakemake-workflow-catalog.yml",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "LICENSE",
    "LICENSE-DATA",
    "README.md",
    "Snakefile",
    "codecheck.yml",
    "environment.txt",
    "pyproject.toml",
}
"""Every file at the top level: add one here if it must lie there."""
TEST = """
from pathlib import Path
def test_that_passes():
    Path({path!r}).write_text("left")
"""


def git(folder, *words) -> str:
    command = ["git", "-C", str(folder), *words]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_git_tracks_a_short_list_of_files_at_the_top():
    if not (ROOT / ".git").exists():
        skip("this folder is no clone", "git clone")
    assert {name for name in git(ROOT, "ls-files").splitlines() if "/" not in name} == TOP


@pytest.mark.parametrize(("path", "code"), [("mine.nc", 1), ("tracked", 1), ("ignored", 0)])
def test_a_session_that_leaves_a_file_in_the_project_fails_and_names_it(tmp_path, path, code):
    (tmp_path / ".gitignore").write_text("ignored\n__pycache__\n.pytest_cache\n")
    (tmp_path / "tracked").touch()
    git(tmp_path, "init", "--quiet")
    git(tmp_path, "add", ".")
    (tmp_path / "test_it.py").write_text(TEST.format(path=str(tmp_path / path)))
    words = ["-m", "pytest", "-p", "clean_tree", "-n", "2", "--rootdir", str(tmp_path)]
    done = subprocess.run(
        [sys.executable, *words, str(tmp_path)],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT / "tests"), "PYTEST_ADDOPTS": ""},
        capture_output=True,
        text=True,
    )
    assert done.returncode == code, done.stdout + done.stderr
    assert "1 passed" in done.stdout
    assert (path in done.stdout) == bool(code)
