"""Time and disk space of a whole reproduction: from scratch, with kernels, and up to date.

It runs in a copy of the project in a temporary folder, with its own cache of kernels.
"""

import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from latticode.kernels.sources import describe_machine

from .timing import timed

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = shutil.ignore_patterns(
    "results", ".snakemake", "__pycache__", ".git", ".venv", ".*_cache", ".hypothesis"
)
RUNS = {
    "cold": "nothing compiled before",
    "nothing": "nothing to do",
    "warm": "kernels compiled before",
}


def run(project: Path) -> dict:
    """Run snakemake in `project`, and return its wall time and processor time in s.

    If it fails, its output is printed, because the copy of the project is deleted.
    """
    # the environment has the original project installed, so the copy must come first
    packages = (project / "packages/latticode", project / "scripts", project)
    environment = {
        **os.environ,
        "LATTICODE_CACHE": str(project.with_name("kernels")),
        "PYTHONPATH": os.pathsep.join(map(str, packages)),
    }
    command = [sys.executable, "-m", "snakemake"]
    before = _processor_time()
    done, seconds = timed(
        lambda: subprocess.run(
            command, cwd=project, env=environment, capture_output=True, text=True
        )
    )
    if done.returncode:
        print(done.stdout, done.stderr, sep="\n", file=sys.stderr)
        done.check_returncode()
    return {"wall": round(seconds, 2), "processor": round(_processor_time() - before, 2)}


def _processor_time() -> float:
    """Return the processor time in s of all descendants of this process."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(project: Path) -> dict:
    """Return the figures of runs in `project`: from scratch, up to date, and with kernels."""
    runs = {}
    for name in RUNS:
        if name == "warm":
            shutil.rmtree(project / "results")
            shutil.rmtree(project / ".snakemake")
        runs[name] = run(project)
    folders = {"packages": Path(sys.prefix), "results": project / "results"}
    megabytes = {name: _megabytes(folder) for name, folder in folders.items()}
    machine = {**describe_machine(), "cores": os.cpu_count()}
    return {"machine": machine, "runs": runs, "megabytes": megabytes}


def _megabytes(folder: Path) -> int:
    files = (path for path in folder.rglob("*") if path.is_file() and not path.is_symlink())
    return round(sum(path.stat().st_size for path in files) / 1e6)


def measure_reproduction(data: str) -> None:
    """Measure in a copy of the project, and write the figures to the JSON file `data`."""
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder) / "project"
        shutil.copytree(ROOT, project, ignore=LEFT_OUT)
        measured = measure(project)
    Path(data).write_text(json.dumps(measured, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(measured["runs"], indent=1))
