"""How long the whole reproduction takes: from nothing, warm, and with nothing to do.

Run as `python -m benchmarks.reproduction` in the project's folder; it works on a copy of the
project in a temporary folder and prints two tables.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

from pendula.report.words import markdown

from .timing import timed

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = shutil.ignore_patterns(
    "results", ".snakemake", "__pycache__", ".git", ".venv", ".*_cache", ".hypothesis"
)


def run(project: Path) -> float:
    """Run snakemake in `project` and return the wall time in seconds."""
    command = [sys.executable, "-m", "snakemake"]
    environment = {k: v for k, v in os.environ.items() if k != "PENDULA_CACHE"}
    _, seconds = timed(
        lambda: subprocess.run(
            command, cwd=project, env=environment, check=True, capture_output=True
        )
    )
    return seconds


def rule_times(project: Path) -> dict[str, list[float]]:
    """Return the wall times of the jobs of each rule, from Snakemake's own records."""
    jobs = {}  # each output has a record; those of one job have the same times
    for record in (project / ".snakemake" / "metadata").iterdir():
        data = json.loads(record.read_text())
        if data.get("starttime") and data.get("rule"):
            jobs[data["rule"], data["starttime"]] = data["endtime"] - data["starttime"]
    times = defaultdict(list)
    for (rule, _), seconds in jobs.items():
        times[rule].append(seconds)
    return times


def main() -> None:
    """Measure in a copy of the project, and print what was measured."""
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder) / "project"
        shutil.copytree(ROOT, project, ignore=LEFT_OUT)
        runs = [("everything, nothing compiled yet", run(project))]
        runs.append(("nothing to do", run(project)))
        shutil.rmtree(project / "results")
        shutil.rmtree(project / ".snakemake")
        runs.append(("everything, kernels compiled before", run(project)))
        rules = sorted(rule_times(project).items(), key=lambda item: -max(item[1]))
    print(markdown(["run", "wall time, s"], [(name, f"{seconds:.1f}") for name, seconds in runs]))
    rows = [(rule, len(times), f"{max(times):.1f}") for rule, times in rules]
    print("\n" + markdown(["rule", "jobs", "longest, s"], rows))


if __name__ == "__main__":
    main()
