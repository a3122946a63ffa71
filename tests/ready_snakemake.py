"""A process that has imported Snakemake and forks for each run that a test asks for.

Nearly half of a dry run is the import of Snakemake and of the packages that it uses. A run here is
still a process of its own, with its own folder, screen and exit code, and it imports the project
anew. What is there already is what other people wrote. `helpers.py` starts this process and asks
it. It asks for `python -m doctest` too, for which the same packages are imported.
"""

import atexit
import gc
import importlib
import json
import os
import runpy
import sys

PACKAGES = (
    *("snakemake.cli", "snakemake.report.html_reporter"),
    *("pydantic", "smart_open", "yte", "nbformat", "platformdirs"),
    *("numba", "xarray", "scipy.special", "scipy.optimize", "matplotlib.figure"),
)
"""What every run or a doctest imports, whatever it is asked for."""
status = 0
"""The exit code of a fork."""


def serve() -> list[str] | None:
    """Fork for each line of standard input; in a fork return a module's name and its arguments."""
    for line in iter(sys.stdin.readline, ""):
        folder, variables, screens, arguments = json.loads(line)
        if not (child := os.fork()):
            os.chdir(folder)
            os.environ.clear()
            os.environ.update(variables)
            _take(os.open(os.devnull, os.O_RDONLY), 0)
            for number, path in enumerate(screens, 1):
                _take(os.open(path, os.O_WRONLY), number)
            return arguments
        _, status = os.waitpid(child, 0)
        print(os.waitstatus_to_exitcode(status), flush=True)
    return None


def _take(opened: int, number: int) -> None:
    if opened != number:
        os.dup2(opened, number)
        os.close(opened)


def get_ready() -> None:
    """Import what other people wrote, and find the plugins of Snakemake, which is slow too."""
    for name in PACKAGES:
        importlib.import_module(name)
    sys.modules["snakemake.cli"].get_argument_parser()
    gc.collect()
    gc.freeze()
    gc.disable()  # no run of a test makes garbage that is worth the time


def leave() -> None:
    """End without taking apart all that was imported."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def main() -> None:
    """Get ready once, and in each fork be Snakemake or doctest."""
    global status
    atexit.register(leave)  # the first that is registered is the last that is done
    get_ready()
    sys.path[0] = ""  # as `python -m` does, so that no test's helper is found by a workflow
    request = serve()
    if request is None:
        return
    sys.argv[:] = request
    try:
        if sys.argv[0] == "doctest":
            sys.path[1:1] = os.environ["PYTHONPATH"].split(os.pathsep)
            runpy.run_module("doctest", run_name="__main__")
        importlib.import_module("snakemake.cli").main()
    except SystemExit as end:
        status = int(end.code or 0)


if __name__ == "__main__":
    main()
