"""Where the time of a whole reproduction goes: from nothing, with compiled kernels, without work.

Run as `python -m benchmarks.reproduction DATA` in the project's folder. It works on a copy of the
project in a temporary folder, with a cache of kernels of its own, writes what was measured as JSON
to DATA, and prints it as tables. What is measured is processor time: jobs tell theirs in their logs
(see scripts/job.py), and the rest of all that a run takes is that of Snakemake.
"""

import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import job
from pendula.report.words import markdown
from pendula.sources import describe_machine

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
KINDS = ("start-up", "imports", "compiling", "computing", "drawing", "writing")
"""What processor time is spent on. Jobs are forks of a process that imported for all of them; the
start-up of a job that is none holds its imports too."""
SNAKEMAKE = "Snakemake"
"""The row of all that no job took."""


def run(project: Path) -> dict:
    """Run snakemake in `project`; return its wall time and processor time.

    Where it fails, what it said goes to the log of this measurement, since the copy is removed.
    """
    environment = {**os.environ, "PENDULA_CACHE": str(project.with_name("kernels"))}
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
    """Return the processor time of all that this process started, at any depth."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def jobs_of(logs: Path) -> dict[str, dict[str, float]]:
    """Return what each job told of itself, by the name of its log below `logs`."""
    jobs = {}
    for log in sorted(logs.rglob("*.log")):
        told = {}
        for line in log.read_text(encoding="utf-8").splitlines():
            if line.startswith(job.SPENT):
                told |= json.loads(line.removeprefix(job.SPENT))
            elif line.startswith(job.TOOK):
                told["wall"] = float(line.removeprefix(job.TOOK).split()[0])
        if "memory" in told:
            jobs[log.relative_to(logs).with_suffix("").as_posix()] = told
    return jobs


def spent(told: dict[str, float]) -> float:
    """Return the whole processor time of a job."""
    return sum(told.get(kind, 0.0) for kind in KINDS)


def rest(measured: dict) -> float:
    """Return the processor time of a run that none of its jobs took."""
    return measured["processor"] - sum(map(spent, measured["jobs"].values()))


def memory(measured: dict) -> float:
    """Return the largest memory of any job of a run, in megabytes."""
    return max(told["memory"] for told in measured["jobs"].values())


def table(measured: dict) -> str:
    """Return the jobs of a run, the costliest first, in seconds and megabytes."""
    rows = [(name, told) for name, told in measured["jobs"].items()]
    rows.append((SNAKEMAKE, {"start-up": rest(measured)}))
    totals = {kind: sum(told.get(kind, 0.0) for _, told in rows) for kind in KINDS}
    rows = [("all", totals), *sorted(rows, key=lambda row: -spent(row[1]))]
    return markdown(
        ["job", *KINDS, "sum", "memory"],
        [
            (name, *(_shown(told.get(kind, 0.0)) for kind in KINDS), f"{spent(told):.2f}", largest)
            for name, told in rows
            for largest in [f"{told['memory']:.0f}" if "memory" in told else ""]
        ],
    )


def _shown(seconds: float) -> str:
    return f"{seconds:.2f}" if seconds >= 0.005 else ""


def measure(project: Path) -> dict:
    """Run everything twice in `project`, and once more with nothing to do."""
    runs = {}
    for name in RUNS:
        if name == "warm":
            shutil.rmtree(project / "results")
            shutil.rmtree(project / ".snakemake")
        runs[name] = run(project)
        runs[name]["jobs"] = {} if name == "nothing" else jobs_of(project / "results/logs")
    return {"machine": {**describe_machine(), "cores": os.cpu_count()}, "runs": runs}


def main(data: Path) -> None:
    """Measure in a copy of the project, write and print what was measured."""
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder) / "project"
        shutil.copytree(ROOT, project, ignore=LEFT_OUT)
        measured = measure(project)
    data.write_text(json.dumps(measured, indent=1) + "\n", encoding="utf-8")
    runs = measured["runs"].items()
    rows = [(RUNS[name], f"{one['wall']:.1f}", f"{one['processor']:.1f}") for name, one in runs]
    print(markdown(["run", "wall time, s", "processor time, s"], rows))
    for name, one in runs:
        if one["jobs"]:
            print(f"\nSeconds of processor time, and megabytes: {RUNS[name]}\n")
            print(table(one))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
