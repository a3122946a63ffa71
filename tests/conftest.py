"""Fixtures of several tests, and how hypothesis draws: the same data every time, no time limit."""

import fcntl
import gc
import os
import shutil
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from helpers import MY_BASELINE, ROOT, copy_of_sources, skips_in_words, snakemake
from hypothesis import settings
from hypothesis.internal.conjecture import providers
from oracle import CASES, slope
from scipy.integrate import solve_ivp

pytest_plugins = ["figure_fixtures"]
gc.disable()  # while modules are imported and tests are collected, all of which stay

settings.register_profile(
    "project", deadline=None, derandomize=True, database=None, max_examples=50
)
settings.load_profile("project")
# It would parse the whole library, in every worker, to draw the numbers that stand there as well:
# this takes seconds, and whoever edits one of them would have all tests draw other data.
providers._get_local_constants = lambda: providers._local_constants


LONGEST = ("docs/test_commands.py", "workflow/test_figure_diff.py", "workflow/test_interrupted.py")
"""Files that begin first: at the end, the other workers would wait for one of their tests."""


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    """Let every second worker import the files of tests from the last one on.

    In a new clone pytest compiles each file for its assertions, and keeps it: two workers that
    meet in the middle compile half of the files each.
    """
    report = yield
    backwards = os.environ.get("PYTEST_XDIST_WORKER", "gw0")[2:] in "13579"
    if backwards and isinstance(collector, pytest.Directory):
        report.result.reverse()
    return report


def pytest_collection_modifyitems(items):
    """Put the tests of the longest files before all others, and give all workers one order."""
    first = [ROOT / "tests" / name for name in LONGEST]
    items.sort(key=lambda item: (item.path not in first, item.path))


def pytest_collection_finish():
    """From now on look for garbage, but not among all that has been imported and collected."""
    gc.collect()
    gc.freeze()
    gc.enable()


def pytest_terminal_summary(terminalreporter):
    """List each test that was skipped, with the reason and the way to have it run."""
    lines = skips_in_words(terminalreporter.stats.get("skipped", ()))
    if lines:
        terminalreporter.section("not run")
    for line in lines:
        terminalreporter.line(line)


@pytest.fixture(scope="session")
def scipy_solution():
    """Return a function: the amplitudes (2, 61) of a case of the paper at some tau, by SciPy."""

    @cache
    def solve(case, tau):
        omega, pair = CASES[case]
        start = np.zeros((2, 61), complex)
        start[:, 30] = pair

        def right_hand_side(_, z):
            return slope(z.reshape(2, 61), (1.0, 1.0, omega), "dirichlet").ravel()

        run = solve_ivp(
            right_hand_side, (0, tau), start.ravel(), method="DOP853", rtol=3e-14, atol=1e-14
        )
        return run.y[:, -1].reshape(2, 61)

    return solve


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
    """Return a folder with the results of a full run of config/quick.yaml."""

    def make(directory):
        result = snakemake(ROOT, directory)
        assert result.returncode == 0, result.stdout + result.stderr

    return made_once("full_run", make)


@pytest.fixture(scope="session")
def accepted_once(full_run, made_once) -> Path:
    """Return a folder with a clone and a finished run with a baseline in it, not to be changed."""

    def make(folder):
        clone = copy_of_sources(folder / "clone")
        for name in ("accepted.json", "hashes.json"):  # which this run cannot replace
            shutil.copy(ROOT / "tests/baseline" / name, clone / "tests/baseline")
        finished = shutil.copytree(full_run, folder / "finished")
        command = ("accept_figures", "--config", f"baseline={MY_BASELINE}")
        result = snakemake(clone, finished, *command)
        assert result.returncode == 0, result.stdout + result.stderr

    return made_once("accepted", make)


@pytest.fixture(scope="session")
def packed(full_run, made_once) -> Path:
    """Return a copy of the finished run with its archive."""

    def make(folder):
        shutil.copytree(full_run, folder, dirs_exist_ok=True)
        result = snakemake(ROOT, folder, "archive")
        assert result.returncode == 0, result.stderr

    return made_once("packed", make)
