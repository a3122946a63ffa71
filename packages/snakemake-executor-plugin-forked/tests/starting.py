"""Starts `python -m snakemake` as a fork of a process that has imported it."""

import multiprocessing
import os
import runpy
import signal
import sys
from functools import cache
from pathlib import Path

PACKAGES = ["snakemake.cli", "snakemake.executors.local", "nbformat"]


@cache
def forking():
    """Return what forks from a process that has imported PACKAGES; only some systems can."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(PACKAGES)
    return context


def be(python, folder, screen, variables, arguments) -> None:
    """Be `python -m snakemake <arguments>` in a session of its own, with a file as its screen."""
    os.setsid()
    signal.signal(signal.SIGINT, signal.default_int_handler)
    output = os.open(screen, os.O_WRONLY)
    for number in (1, 2):
        os.dup2(output, number)
    os.close(output)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(variables)
    sys.path[:0] = ["", *filter(None, variables.get("PYTHONPATH", "").split(os.pathsep))]
    sys.executable, sys.argv = python, ["snakemake", *arguments]
    runpy.run_module("snakemake", run_name="__main__", alter_sys=True)


class Run:
    """A run of Snakemake that is under way, as `subprocess.Popen` has it."""

    def __init__(self, python: Path, folder: Path, arguments: list[str], variables: dict[str, str]):
        screen = folder.parent / f"screen{len(list(folder.parent.iterdir()))}"
        os.mkfifo(screen)
        passed = (str(python), folder, screen, variables, arguments)
        self._process = forking().Process(target=be, args=passed)
        self._process.start()
        self.pid, self.kill = self._process.pid, self._process.kill
        self.stdout = screen.open()

    def end(self) -> tuple[int, str]:
        """Return the exit status and the rest of what was said: by all that have the screen."""
        output = self.stdout.read()
        self._process.join()
        return self._process.exitcode, output
