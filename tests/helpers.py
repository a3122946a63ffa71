"""What many tests use: the real snakemake, waiting without a clock, and skips with a way out."""

import importlib
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import NamedTemporaryFile
from types import ModuleType
from typing import NoReturn

import machines
import pytest
import yaml
from pendula.configuration.files import gather
from pendula.configuration.messages import load

ROOT = Path(__file__).resolve().parents[1]
Finished = subprocess.CompletedProcess

HANGS = 600
"""Seconds after which something hangs: far more than anything takes on the slowest machine, so that
no test hangs on the clock. It is the only limit of time in the tests."""


WAY = "; to have it run: "

NOISE = ("Traceback", "common.smk", 'File "', "WorkflowError", "Exception")
"""What of Snakemake's words tells a person nothing, and must not reach the screen with a fault."""

MY_BASELINE = "my_baseline"
"""The folder in the shared quick run that is its baseline."""

PARTS = (
    *("Snakefile", "workflow", "scripts", "benchmarks", "config", "profiles", "environment.txt"),
    *(f"tests/baseline/{part}" for part in ("reference", "proofs", "speed", "quoted")),
)
"""What of the project a run needs."""


def skip(reason: str, way: str) -> NoReturn:
    """Skip this test; `reason` says what is missing, `way` what to install or where to run it."""
    pytest.skip(f"{reason}{WAY}{way}", allow_module_level=True)


def need_machine(name: str) -> None:
    """Skip if PENDULA_PLAYED is not set, or if this computer cannot play the machine `name`."""
    if not os.environ.get("PENDULA_PLAYED"):
        skip("what is compiled for other processors takes minutes", "run .ci/elsewhere bits")
    if why := machines.why_not(name):
        skip(why, machines.ELSEWHERE)


def another_numba(folder: Path) -> dict[str, str]:
    """Return the environment of a process in which numba says that it is of an unknown version."""
    said = folder / "numba-0.0.1.dist-info/METADATA"
    said.parent.mkdir()
    said.write_text("Metadata-Version: 2.1\nName: numba\nVersion: 0.0.1\n")
    return os.environ | {"PYTHONPATH": str(folder)}


def package(module: str, install: str) -> ModuleType:
    """Return a module that some tests need; where it is missing, skip and say what to install."""
    try:
        return importlib.import_module(module)
    except ImportError:
        skip(f"{module.split('.')[0]} is not installed", f"pip install {install}")


def wait_for(happened: Callable[[], object]) -> None:
    """Return as soon as `happened()` is true, however long that takes, unless it hangs."""
    start = time.monotonic()
    while not happened():
        assert time.monotonic() - start < HANGS, "what the test waits for did not happen"
        time.sleep(0.01)


def chosen(study: str, *over: str):
    """Return the validated section of a study, with the files of these names laid over it."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", study, *over)]
    raw = gather(files, {})
    kept = {"cases", "sweeps", "solvers", "limits", study}
    return getattr(load({key: raw[key] for key in raw.keys() & kept}), study)


def snakemake(
    project: Path, directory: Path, *arguments: str, env: dict[str, str] | None = None
) -> subprocess.CompletedProcess:
    """Run snakemake on the quick configuration of `project`, with its results in `directory`."""
    configuration = project / "config" / "quick.yaml"
    command = command_of(project, directory, configuration, *arguments)
    if env is not None:  # which decides how packages are imported
        return subprocess.run(command, capture_output=True, text=True, env=env)
    return run_ready(command)


def snakemake_with(
    settings: dict, project: Path, directory: Path, *arguments: str
) -> subprocess.CompletedProcess:
    """Run snakemake with a configuration of one's own beside the project's."""
    mine = directory / "mine.yaml"
    mine.write_text(yaml.safe_dump(settings))
    return run_ready(command_of(project, directory, mine, *arguments))


def run_ready(command: list[str], folder: Path | None = None, **variables: str) -> Finished:
    """Run `python -m snakemake ...`, or `doctest`, as a fork of a process that has imported it."""
    with NamedTemporaryFile("r") as out, NamedTemporaryFile("r") as err:
        environment = {**os.environ, **variables}
        request = [str(folder or Path.cwd()), environment, [out.name, err.name], command[2:]]
        return Finished(command, ask_ready(json.dumps(request)), out.read(), err.read())


def ask_ready(request: str) -> int:
    """Have that process do what `request` says, in one line, and return the exit code."""
    process = _ready()
    process.stdin.write(f"{request}\n")
    process.stdin.flush()
    return int(process.stdout.readline())


@cache
def _ready() -> subprocess.Popen:
    """Start that process, once for each worker of pytest; it ends when its input does."""
    return subprocess.Popen(
        [sys.executable, str(ROOT / "tests/ready_snakemake.py")],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )


def command_of(project: Path, directory: Path, configuration: Path, *arguments: str) -> list[str]:
    """Return the command; --configfile takes all that follows it, so it stands last."""
    options = ["--snakefile", project / "Snakefile", "--directory", directory]
    words = [sys.executable, "-m", "snakemake", *arguments, *options, "--configfile", configuration]
    return [str(word) for word in words]


def planned(project: Path, directory: Path, *arguments: str) -> dict[str, int]:
    """Return the number of jobs of each rule that snakemake would run."""
    return _jobs(snakemake(project, directory, "--dry-run", *arguments))


def planned_with(settings: dict, project: Path, directory: Path, *arguments: str) -> dict[str, int]:
    """Return the same with a configuration of one's own."""
    return _jobs(snakemake_with(settings, project, directory, "--dry-run", *arguments))


def _jobs(result: subprocess.CompletedProcess) -> dict[str, int]:
    assert result.returncode == 0, result.stdout + result.stderr
    return jobs_in(result.stdout + result.stderr)


def jobs_in(text: str) -> dict[str, int]:
    """Return the number of jobs of each rule in what a dry run said."""
    if "Nothing to be done" in text:
        return {}
    table = text[text.index("Job stats:") :].split("\n\n")[0].splitlines()[3:]
    return {row.split()[0]: int(row.split()[1]) for row in table if row.split()[0] != "total"}


def copy_of_sources(project: Path) -> Path:
    """Make a fresh copy of the project's sources, and return it."""
    for part in PARTS:
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(
                source,
                project / part,
                ignore=shutil.ignore_patterns("__pycache__"),
                copy_function=shutil.copy,
            )
        else:
            (project / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, project / part)
    return project


def edit(path: Path, old: str, new: str) -> None:
    """Replace the one place in a file where `old` stands."""
    text = path.read_text()
    assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {path}"
    path.write_text(text.replace(old, new))


def change(path: Path) -> None:
    """Add a line of code to a module, which must be there: `open("a")` would create it."""
    path.write_text(path.read_text() + "CHANGED = True\n")
