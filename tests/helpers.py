"""Functions for many tests: runs of snakemake, and skips that report what to install."""

import json
import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from tempfile import NamedTemporaryFile
from types import ModuleType
from typing import NoReturn

import pytest
import yaml
from latticode.configuration.files import gather
from pendula.configuration.messages import load

ROOT = Path(__file__).resolve().parents[1]
Finished = subprocess.CompletedProcess

WAY = "; to have it run: "

MY_BASELINE = "my_baseline"
"""The folder of the baseline in the shared quick run."""


def skip(reason: str, way: str) -> NoReturn:
    """Skip this test; `reason` is what is missing, `way` what to install or where to run it."""
    pytest.skip(f"{reason}{WAY}{way}", allow_module_level=True)


def python_path(project: Path = ROOT) -> str:
    """Return the folders in which Python finds the packages of a copy of the project."""
    places = "packages/latticode", "scripts", ""
    return os.pathsep.join(str(project / place) for place in places)


def package(module: str, install: str) -> ModuleType:
    """Return a module that some tests need; if it is missing, skip and print what to install."""
    reason = f"{module.split('.')[0]} is not installed{WAY}pip install {install}"
    return pytest.importorskip(module, reason=reason, exc_type=ImportError)


def chosen(study: str, *over: str):
    """Return the validated section of a study; the files `over` override its values."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", study, *over)]
    raw = gather(files, {})
    sections = {"cases", "sweeps", "solvers", "limits", study}
    return getattr(load({key: raw[key] for key in raw.keys() & sections}), study)


def snakemake(
    project: Path, directory: Path, *arguments: str, settings: dict | None = None, **variables: str
) -> Finished:
    """Run snakemake in `directory` with `settings`, by default the quick configuration."""
    configuration = project / "config/quick.yaml"
    if settings is not None:
        (configuration := directory / "mine.yaml").write_text(yaml.safe_dump(settings))
    variables = {"PYTHONPATH": python_path(project)} | variables
    return run_ready(command_of(project, directory, configuration, *arguments), **variables)


def run_ready(command: list[str], folder: Path | None = None, **variables: str) -> Finished:
    """Run `python -m snakemake ...`, or `doctest`, as a fork of a process that has imported it."""
    with NamedTemporaryFile("r") as out, NamedTemporaryFile("r") as err:
        environment = {**os.environ, **variables}
        request = [str(folder or Path.cwd()), environment, [out.name, err.name], command[2:]]
        (process := _ready()).stdin.write(f"{json.dumps(request)}\n")
        process.stdin.flush()
        return Finished(command, int(process.stdout.readline()), out.read(), err.read())


@cache
def _ready() -> subprocess.Popen:
    """Start the process that forks, once per worker of pytest; it ends when its input closes."""
    command = [sys.executable, str(ROOT / "tests/ready_snakemake.py")]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def command_of(project: Path, directory: Path, configuration: Path, *arguments: str) -> list[str]:
    """Return the command; --configfile is last, because it takes all arguments after it."""
    options = ["--snakefile", project / "Snakefile", "--directory", directory]
    words = [sys.executable, "-m", "snakemake", *arguments, *options, "--configfile", configuration]
    return [str(word) for word in words]


def planned(
    project: Path, directory: Path, *arguments: str, settings: dict | None = None
) -> dict[str, int]:
    """Return the number of jobs of each rule that snakemake would run."""
    result = snakemake(project, directory, "--dry-run", *arguments, settings=settings)
    text = result.stdout + result.stderr
    assert result.returncode == 0, text
    if "Nothing to be done" in text:
        return {}
    table = text[text.index("Job stats:") :].split("\n\n")[0].splitlines()[3:]
    return {row.split()[0]: int(row.split()[1]) for row in table if row.split()[0] != "total"}


def edit(path: Path, old: str, new: str) -> None:
    """Replace the only occurrence of `old` in a file."""
    text = path.read_text()
    assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {path}"
    path.write_text(text.replace(old, new))


def change(path: Path) -> None:
    """Add a line of code to a module, which must exist: `open("a")` would create it."""
    path.write_text(path.read_text() + "CHANGED = True\n")
