"""A session of tests fails if it changes what git tracks or leaves a file that is not ignored."""

import subprocess

import pytest

STATUS = pytest.StashKey[set[str]]()


def status_of_git(folder) -> set[str]:
    """Return the lines of `git status`; no lines if the folder is not a clone."""
    command = ["git", "-C", str(folder), "status", "--porcelain", "--untracked-files=all"]
    return set(subprocess.run(command, capture_output=True, text=True).stdout.splitlines())


def pytest_sessionstart(session):
    """Store the state of git before the first test: developers may have changed files."""
    if not hasattr(session.config, "workerinput"):  # not in each worker of pytest-xdist
        session.stash[STATUS] = status_of_git(session.config.rootpath)


def pytest_sessionfinish(session):
    """Print the files that tests changed or left, and let the session fail."""
    before = session.stash.get(STATUS, None)
    if before is None:
        return
    changes = sorted(status_of_git(session.config.rootpath) - before)
    if changes:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
        reporter = session.config.pluginmanager.get_plugin("terminalreporter")
        reporter.section("the tests changed the project's folder (git status)", red=True)
        for line in changes:
            reporter.write_line(line)
