"""A process that has imported Snakemake and forks for each run that a test asks for.

Nearly half of a dry run is the import of Snakemake and of the packages that it uses. A run here is
still a process of its own, with its own folder, screen and exit code, and it imports the project
anew: only what other people wrote is there already. `helpers.py` starts this process and asks it.
"""

import gc
import importlib
import json
import os
import sys

PACKAGES = (
    *("snakemake.cli", "snakemake.report.html_reporter"),
    *("pydantic", "smart_open", "yte"),
)
"""What every run imports, whatever it is asked for."""


def serve() -> list[str]:
    """Fork for each line of standard input; return the arguments in a fork."""
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
    sys.exit()


def _take(opened: int, number: int) -> None:
    os.dup2(opened, number)
    os.close(opened)


def main() -> None:
    """Import once, and in each fork be Snakemake."""
    sys.path[0] = ""  # as `python -m` does, so that no test's helper is found by a workflow
    for name in PACKAGES:
        importlib.import_module(name)
    gc.freeze()
    sys.argv[:] = ["snakemake", *serve()]
    importlib.import_module("snakemake.cli").main()


if __name__ == "__main__":
    main()
