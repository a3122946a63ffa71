"""When jobs begin: at once, and first that with the longest way from it to the end of the run.

With few cores, a run takes longest where a long chain of jobs begins late and ends alone. How long
a job takes is known from an earlier run, in this folder or of the accepted results.
"""

import json
from collections.abc import Mapping
from pathlib import Path

from pendula.spent import TOOK

ACCEPTED = Path(__file__).parents[1] / "tests/baseline/quoted/reproduction.json"
"""Where the time of an accepted full run went; see benchmarks/reproduction.py."""

UNKNOWN = 1.0
"""Seconds of a job that never ran."""

UNASKED = 100, 1
"""Snakemake's own limit, where the user gives none: so many jobs may begin in so many seconds."""


def begin_at_once(scheduler) -> None:
    """Let jobs begin as soon as a core is free, unless the user gave a limit for each second.

    To keep to its limit, Snakemake looks for jobs again a second after each time that it looked.
    After n jobs it therefore looks n times in a second, and when all is done, it waits for the last
    second to pass. On this machine the number of cores keeps jobs from beginning all together.
    """
    limiter = scheduler.job_rate_limiter
    if limiter and (limiter.max_jobs, limiter.timespan) == UNASKED:
        scheduler.job_rate_limiter = None


def put_in_order(dag) -> None:
    """Give each job that will run the seconds from its start to the end of the run as priority.

    Snakemake asks a priority of each rule, before it knows which of its jobs will run. A job that
    the user asked for by --prioritize keeps the highest one.
    """
    ways, accepted = {}, accepted_seconds()

    def way(job) -> float:
        if job not in ways:
            own = seconds_of(job.log[0], accepted) if job.log else 0.0
            later = [way(other) for other in dag.depending[job] if dag.needrun(other)]
            ways[job] = (UNKNOWN if own is None else own) + max(later, default=0.0)
        return ways[job]

    for job in list(dag.needrun_jobs()):
        if job.priority != job.HIGHEST_PRIORITY:
            dag._priority[job] = way(job)


def accepted_seconds() -> dict[str, float]:
    """Return the wall time of each job of the accepted full run, by its log, if it is there."""
    if not ACCEPTED.exists():
        return {}
    runs = json.loads(ACCEPTED.read_text(encoding="utf-8"))["runs"]
    return {k: told["wall"] for k, told in runs["warm"]["jobs"].items() if "wall" in told}


def seconds_of(log: str, accepted: Mapping[str, float]) -> float | None:
    """Return the wall time of a job as its log, or else the accepted run, tells it."""
    last = _lines(log)[-1:]
    if last and last[0].startswith(TOOK):
        return float(last[0].removeprefix(TOOK).split()[0])
    return accepted.get(log.removeprefix("results/logs/").removesuffix(".log"))


def _lines(log: str) -> list[str]:
    path = Path(log)
    return path.read_text(encoding="utf-8", errors="replace").splitlines() if path.exists() else []
