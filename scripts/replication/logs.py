"""The last line of a job's log: its wall time and its largest memory."""

import re
from pathlib import Path

TOOK = "wall time: "
"""The beginning of the last line of a job's log."""
LAST_LINE = re.compile(rf"{TOOK}([\d.]+) s, largest memory: (\d+) MB")


def last_line(seconds: float, megabytes: float) -> str:
    """Return the last line of a log."""
    return f"{TOOK}{seconds:.1f} s, largest memory: {megabytes:.0f} MB\n"


def run_times(folder: Path) -> list[tuple[str, float, str]]:
    """Return name, wall time in s and memory in MB of each job with a log, the longest first."""
    times = []
    for log in sorted(folder.rglob("*.log")):
        line = log.read_text(encoding="utf-8", errors="replace").rstrip().rpartition("\n")[2]
        if took := LAST_LINE.match(line):
            name = log.relative_to(folder).with_suffix("").as_posix()
            times.append((name, float(took[1]), took[2]))
    return sorted(times, key=lambda job: (-job[1], job[0]))
