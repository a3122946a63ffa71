"""Fixtures of several tests, and how hypothesis draws: the same data every time, no time limit."""

import fcntl
import os
from contextlib import chdir
from pathlib import Path

import pendula.names  # noqa: F401, so that datasets have the paper's words
import pytest
from helpers import MY_BASELINE, ROOT, snakemake
from hypothesis import settings

settings.register_profile(
    "project", deadline=None, derandomize=True, database=None, max_examples=50
)
settings.load_profile("project")


@pytest.fixture(scope="session", autouse=True)
def _away_from_the_users_results(tmp_path_factory):
    """Have all tests stand in an empty folder: that of the project may hold a user's results."""
    with chdir(tmp_path_factory.mktemp("empty")):
        yield


@pytest.fixture(scope="session")
def made_once(tmp_path_factory):
    """Return a function: a folder that `make` fills, by one of all workers for the others too.

    PENDULA_FULL_RUN names a folder for them that outlives the session, so that another takes over.
    """
    parallel = "PYTEST_XDIST_WORKER" in os.environ
    base = tmp_path_factory.getbasetemp()
    kept = os.environ.get("PENDULA_FULL_RUN")
    shared = Path(kept) if kept else (base.parent if parallel else base)

    def provide(name, make):
        directory = shared / name
        directory.mkdir(parents=True, exist_ok=True)
        with open(shared / f"{name}.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not (shared / f"{name}.done").exists():
                make(directory)
                (shared / f"{name}.done").touch()
        return directory

    return provide


@pytest.fixture(scope="session")
def full_run(made_once) -> Path:
    """Return a folder with a full run of config/quick.yaml, its archive and its own baseline."""

    def make(directory):
        targets = ("all", "archive", "accept_figures")
        result = snakemake(ROOT, directory, *targets, "--config", f"baseline={MY_BASELINE}")
        assert result.returncode == 0, result.stdout + result.stderr

    return made_once("full_run", make)
