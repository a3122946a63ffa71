"""A process that has imported Snakemake and forks for each run that a test asks for.

The import of Snakemake and its packages takes nearly half of the time of a dry run. Each run is a
separate process with its own folder, output and exit code, and imports the project itself.
`helpers.py` starts this process and sends it runs, also of `python -m doctest`.
"""

import atexit
import gc
import importlib
import json
import os
import runpy
import sys

PACKAGES = (
    "snakemake.cli",
    "snakemake.report.html_reporter",
    "pydantic",
    "smart_open",
    "yte",
    "nbformat",
    "platformdirs",
    "numba",
    "xarray",
    "scipy.special",
    "scipy.optimize",
    "matplotlib.figure",
)
"""Modules that runs and doctests import."""
status = 0
"""The exit code of a fork."""


def leave() -> None:
    """End the process without the clean-up of imported modules."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def be(folder: str, variables: dict[str, str], screens: list[str], arguments: list[str]) -> None:
    """Run as `python -m <arguments>`; standard output and errors go to the files `screens`."""
    global status
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(variables)
    for number, path in enumerate([os.devnull, *screens]):
        os.dup2(os.open(path, os.O_RDWR), number)
    # like `python -m`, so that a workflow cannot import helpers of tests
    sys.path[:1] = ["", *filter(None, variables.get("PYTHONPATH", "").split(os.pathsep))]
    sys.argv[:] = arguments
    try:
        runpy.run_module(arguments[0], run_name="__main__", alter_sys=True)
    except SystemExit as end:
        status = int(end.code or 0)


def main() -> None:
    """Import the modules once, and fork for each line of standard input."""
    for name in PACKAGES:
        importlib.import_module(name)
    sys.modules["snakemake.cli"].get_argument_parser()  # finds the plugins, which is slow too
    gc.freeze()
    gc.disable()  # collection would cost more time than it saves
    for line in iter(sys.stdin.readline, ""):
        if not (child := os.fork()):
            return be(*json.loads(line))
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)


if __name__ == "__main__":
    atexit.register(leave)  # registered first, so that it is called last
    main()
