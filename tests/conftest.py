"""How pytest runs the tests: where fixtures are loaded, and what begins first."""

import gc
import os
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as in jobs: waiting threads take a core

FIRST = ("tests/docs/test_commands.py", "tests/workflow/")
"""These tests take seconds each. If they came last, one worker would wait for another."""
LAST = ("tests/configuration/", "tests/replication/", "packages/")
"""Tests without the kernels of the shared run: a second worker begins with them, and so does not
compile these kernels at the same time as that run."""


def pytest_configure(config):
    """Load fixtures where tests run: the process that only hands tests out imports no SciPy."""
    config.pluginmanager.import_plugin("clean_tree")
    if config.option.dist == "no":
        gc.disable()  # modules and tests stay in memory: among them there is no garbage to find
        config.pluginmanager.import_plugin("shared_fixtures")


def pytest_collection_modifyitems(items):
    """Put long tests before all others, and give all workers one order.

    A worker begins with its own share of that order. All that read the shared quick run are in the
    first share, so that no other worker waits while one makes it.
    """
    root = Path(__file__).parents[1]
    first, last = (tuple(str(root / name) for name in names) for names in (FIRST, LAST))

    def rank(item) -> tuple:
        reads, path = "full_run" in getattr(item, "fixturenames", ()), str(item.path)
        return reads or path.startswith(first), reads, not path.startswith(last), path

    items.sort(key=rank, reverse=True)


def pytest_collection_finish():
    """Look for garbage again, but seldom, and leave out all that is in memory by now."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(100_000)
    gc.enable()
