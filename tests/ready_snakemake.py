"""A process that has imported Snakemake and forks for each run that a test asks for.

Nearly half of a dry run is the import of Snakemake and of the packages that it uses. A run here is
still a process of its own, with its own folder, screen and exit code, and it imports the project
anew. `helpers.py` starts this process and asks it, for `python -m doctest` too.
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
"""What every run or a doctest imports, whatever it is asked for."""
status = 0
"""The exit code of a fork."""


def leave() -> None:
    """End without taking apart all that was imported."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def be(folder: str, variables: dict[str, str], screens: list[str], arguments: list[str]) -> None:
    """Be `python -m <arguments>`, with two files as its screen."""
    global status
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(variables)
    for number, path in enumerate([os.devnull, *screens]):
        os.dup2(os.open(path, os.O_RDWR), number)
    # as `python -m` does, so that no test's helper is found by a workflow
    sys.path[:1] = ["", *filter(None, variables.get("PYTHONPATH", "").split(os.pathsep))]
    sys.argv[:] = arguments
    try:
        runpy.run_module(arguments[0], run_name="__main__", alter_sys=True)
    except SystemExit as end:
        status = int(end.code or 0)


def main() -> None:
    """Get ready once, and fork for each line of standard input."""
    for name in PACKAGES:
        importlib.import_module(name)
    sys.modules["snakemake.cli"].get_argument_parser()  # finds the plugins, which is slow too
    gc.freeze()
    gc.disable()  # no run of a test makes garbage that is worth the time
    for line in iter(sys.stdin.readline, ""):
        if not (child := os.fork()):
            return be(*json.loads(line))
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)


if __name__ == "__main__":
    atexit.register(leave)  # the first that is registered is the last that is done
    main()
