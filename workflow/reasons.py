"""Why jobs failed: what their logs say, or else Slurm, or the executor of a signal."""

import logging
import os
import re
import signal
from collections.abc import Iterable
from pathlib import Path

from snakemake.logging import DefaultFormatter

FAILURE = r"(?m)^( *)(?:Error in )?(?:rule|group) (\S+?):\n(?=((?:(?:\1 +|sbatch: |For fur).*\n)*))"
"""An error in Snakemake's log with its details, which are indented more, as jobs of a group are.

Of what sbatch says, only the first line is indented."""
TOLD = r"(?ms)^failed: (.*?)\nTraceback"
"""The reason in the log of a job, see scripts/job.py."""
OF_SLURM = r"(?m)^.*?((?:srun|slurmstepd\S*|sbatch): error: .*|\w+(?:Error|Exception): .*)$"
"""What is a reason in the log that Slurm keeps of a job's screen."""
MORE = {
    "TIMEOUT": "its limit of time: give it more by --set-resources {rule}:runtime=MINUTES",
    "OUT_OF_MEMORY": "its limit of memory: give it more by --set-resources {rule}:mem_mb=MB",
    "CANCELLED": "scancel, or the limit of the partition",
    "NODE_FAIL": "its node was lost: run the same command again",
}
"""What a state of Slurm means, and what to do."""
SIGNAL = r"died with <Signals\.\w+: (\d+)>|returned non-zero exit status (1[3-5]\d)\b"
"""What Snakemake says of a script that a signal ended, or of its shell, which adds 128."""
MEANS = {
    signal.SIGKILL: ": the system does this if memory runs out: try fewer --cores",
    signal.SIGTERM: ": a person or the machine ended it: run the same command again",
    signal.SIGSEGV: ": a library crashed: run the same command again, and report it if it recurs",
}
"""What a signal may mean."""
STATUS_OF_NO_LOG = rf"\bexit status {os.EX_IOERR}\b"
NO_LOG = (
    "its log could not be written, so that its reason is above alone (is the disk full?): make "
    "room, and run the same command again"
)
"""What the exit status means with which such jobs end, see scripts/job.py."""
WORDLESS = "it wrote no reason: its log may be lost, or the machine ended it (out of memory?)"


class Errors(logging.Handler):
    """Keeps Snakemake's errors, which `--quiet` or a full disk may keep out of its own log."""

    def __init__(self):
        super().__init__(logging.ERROR)
        self.setFormatter(DefaultFormatter())
        self.text = ""

    def emit(self, record: logging.LogRecord) -> None:
        self.text += f"{self.format(record)}\n"


def why_jobs_failed(text: str) -> list[tuple[str, str]]:
    """Return why each job failed and which file says more, from Snakemake's errors."""
    found = {}
    for _, rule, details in re.findall(FAILURE, text):
        logs = re.search(r"(?m)^ +log: (.*?) \(check", details)
        for own in [logs[1].split(", ")] if logs and "jobid: " in details else []:
            reason = [*_said(own[0], TOLD), *_by_slurm(rule, details, own), *_signal(rule, text)]
            found[own[0]] = (reason or [WORDLESS])[0], next(filter(_filled, own), own[0])
    return list(found.values())


def _by_slurm(rule: str, details: str, logs: list[str]) -> list[str]:
    """Return what Slurm says of a job: a state that names its limit, or an error on its screen."""
    state = re.search(r"SLURM status is: '(\w+)", details)
    means = MORE.get(state[1]) if state else None
    job = re.search(r"SLURM-job '(\S+)'", details)
    refused = re.findall(r"(?m)(sbatch: error: .*?)'?$", details)
    said = [line for log in logs[1:] for line in _said(log, OF_SLURM)]
    signals = [words for log in logs[1:] for words in _killed(_read(log))]
    ended = [f"Slurm ended job {job[1]} ({state[1]}): {means.format(rule=rule)}"] if means else []
    return [
        *refused,
        *ended,
        *signals,
        *said,
        *([f"Slurm: job {job[1]} is {state[1]}"] if state and job else []),
    ]


def _signal(rule: str, text: str) -> list[str]:
    """Return what the executor said of a job that a signal ended, or Snakemake of its command."""
    forked = re.findall(rf"(?m)^forked: rule {re.escape(rule)} failed: (.*)$", text)
    told = [words for line in forked for words in _in_words(re.findall(r"by signal (\d+)", line))]
    return _killed("\n".join(forked)) + told + forked + _killed(text)


def _killed(text: str) -> list[str]:
    """Return which signals ended scripts, and what they may mean, or that one had no log."""
    no_log = [NO_LOG] if re.search(STATUS_OF_NO_LOG, text) else []
    signals = re.findall(SIGNAL, text)
    return no_log + _in_words(number or int(status) - 128 for number, status in signals)


def _in_words(numbers: Iterable[str | int]) -> list[str]:
    known = (signal.Signals(int(number)) for number in numbers)
    return [f"it was killed by {one.name}" + MEANS.get(one, "") for one in known]


def _said(path: str, pattern: str) -> list[str]:
    return re.findall(pattern, _read(path))


def _filled(path: str) -> bool:
    return bool(_read(path).strip())


def _read(path: str) -> str:
    if not os.path.exists(path):
        return ""
    return Path(path).read_text(encoding="utf-8", errors="replace")
