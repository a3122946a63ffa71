"""Plays the sessions of Python that pages show, each in a fork of one process.

Most of a session would be the import of packages that other people wrote, so they are there
already. A fork imports the project anew, and knows no name of another session.
"""

import doctest
import importlib
import json
import os
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

PACKAGES = (
    *("numba", "pydantic", "netCDF4", "xarray", "scipy.special"),
    "matplotlib.backends.backend_agg",
)


def play(session: Path) -> tuple[int, str]:
    """Return the exit code and the words of `python -m doctest` for a session."""
    heard = session.with_suffix(".heard")
    if not (child := os.fork()):
        with open(heard, "w") as screen, redirect_stdout(screen), redirect_stderr(screen):
            flags = doctest.NORMALIZE_WHITESPACE
            failed, _ = doctest.testfile(str(session), module_relative=False, optionflags=flags)
        os._exit(bool(failed))
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return code, heard.read_text()


if __name__ == "__main__":
    sys.path[0] = ""  # as Python itself does where a reader starts it
    for package in PACKAGES:
        importlib.import_module(package)
    print(json.dumps([play(Path(session)) for session in sys.argv[1:]]))
