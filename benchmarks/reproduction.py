"""How long the whole reproduction takes: from nothing, warm, and with nothing to do.

Run as `python -m benchmarks.reproduction` in the project's folder; it works on a copy of the
project in a temporary folder and prints two tables.
"""

import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

from .timing import timed

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = shutil.ignore_patterns(
    "results", ".snakemake", "__pycache__", ".git", ".venv", ".*_cache", ".hypothesis"
)


def run(project: Path) -> float:
    """Run snakemake in `project` and return the wall time in seconds."""
    command = [sys.executable, "-m", "snakemake"]
    environment = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    _, seconds = timed(
        lambda: subprocess.run(
            command, cwd=project, env=environment, check=True, capture_output=True
        )
    )
    return seconds


def rule_times(project: Path) -> dict[str, list[float]]:
    """Return the wall times of the jobs of each rule, from Snakemake's own records."""
    jobs = {}
    for record in (project / ".snakemake" / "metadata").iterdir():
        data = json.loads(record.read_text())
        if data.get("starttime") and data.get("rule"):
            output = base64.b64decode(record.name.replace("@", "/")).decode()
            key = (data["rule"], data["starttime"])
            jobs[key] = (output, data["endtime"] - data["starttime"])
    times = defaultdict(list)
    for (rule, _), (_, seconds) in jobs.items():
        times[rule].append(seconds)
    return times


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder) / "project"
        shutil.copytree(ROOT, project, ignore=LEFT_OUT)
        print("| run | wall time, s |\n| --- | --- |")
        print(f"| everything, nothing compiled yet | {run(project):.1f} |")
        print(f"| nothing to do | {run(project):.1f} |")
        shutil.rmtree(project / "results")
        shutil.rmtree(project / ".snakemake")
        print(f"| everything, kernels compiled before | {run(project):.1f} |")
        print("\n| rule | jobs | longest, s |\n| --- | --- | --- |")
        for rule, times in sorted(rule_times(project).items(), key=lambda item: -max(item[1])):
            print(f"| {rule} | {len(times)} | {max(times):.1f} |")


if __name__ == "__main__":
    main()
