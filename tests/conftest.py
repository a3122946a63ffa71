"""How pytest runs the tests: where fixtures are loaded, and what begins first."""

import gc
import os
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as in jobs: waiting threads take a core

FIRST = ("docs/test_commands.py", "workflow/")
"""These tests take seconds each. If they came last, one worker would wait for another."""


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
    first = tuple(str(Path(__file__).parent / name) for name in FIRST)

    def place(item) -> tuple:
        reads = "full_run" in getattr(item, "fixturenames", ())
        return not (reads or str(item.path).startswith(first)), not reads, item.path

    items.sort(key=place)


def pytest_collection_finish():
    """Look for garbage again, but seldom, and leave out all that is in memory by now."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(100_000)
    gc.enable()
