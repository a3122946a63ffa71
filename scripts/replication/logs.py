"""Lines of a job's log: its progress, and in the last line its wall time and largest memory."""

import re
import sys
import time
from pathlib import Path

TOOK = "wall time: "
"""The beginning of the last line of a job's log."""
STEPS = 20
"""Number of lines in which a job of many runs logs how many runs are done."""
WORTH_SHOWING = 10.0
"""Shortest remaining time that is logged, in s."""
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


class Progress:
    """Logs how many runs, or other `units`, of a job are done, and the time that is left."""

    def __init__(self, units: str = "runs") -> None:
        self.start, self.units = time.monotonic(), units

    def __call__(self, done: int, count: int) -> None:
        """Log that `done` of `count` are done, STEPS times in all."""
        if done % max(1, count // STEPS) == 0:
            left = (count - done) * (time.monotonic() - self.start) / done
            log_step(f"{done} of {count} {self.units} done{time_left(left)}")


def time_left(seconds: float) -> str:
    """Return ", about 3 min left", or nothing if this is less than WORTH_SHOWING."""
    if seconds < WORTH_SHOWING:
        return ""
    for size, unit in ((3600.0, "h"), (60.0, "min")):
        if seconds >= 1.5 * size:
            return f", about {seconds / size:.0f} {unit} left"
    return f", about {seconds:.0f} s left"


def log_step(text: str) -> None:
    """Write a line on the progress of a job to its log, and sometimes to the screen."""
    step = getattr(sys.stdout, "step", sys.stdout.write)  # a job's log has `step`
    step(f"{text}\n")
