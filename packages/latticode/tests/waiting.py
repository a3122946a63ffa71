"""Waiting without a clock."""

import time
from collections.abc import Callable

HANGS = 600
"""Seconds after which something hangs: far more than anything takes on the slowest machine, so that
no test hangs on the clock. It is the only limit of time in the tests."""


def wait_for(happened: Callable[[], object]) -> None:
    """Return as soon as `happened()` is true, however long that takes, unless it hangs."""
    start = time.monotonic()
    while not happened():
        assert time.monotonic() - start < HANGS, "what the test waits for did not happen"
        time.sleep(0.01)
