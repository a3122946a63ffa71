"""Reasons of failed jobs, from their logs, from Slurm, or from the signal that ended them."""

import logging
import os
import re
import signal
from collections.abc import Iterable
from pathlib import Path

from snakemake.logging import DefaultFormatter

FAILED_JOB = (
    r"(?m)^( *)(?:Error in )?(?:rule|group) (\S+?):\n(?=((?:(?:\1 +|sbatch: |For fur).*\n)*))"
)
"""An error in Snakemake's log with its details, which are indented further, also in groups of jobs.

Of sbatch's output only the first line is indented."""
REASON_IN_LOG = r"(?ms)^failed: (.*?)\nTraceback"
"""The reason in the log of a job, see pendula/contract/log.py."""
REASON_OF_SLURM = r"(?m)^.*?((?:srun|slurmstepd\S*|sbatch): error: .*|\w+(?:Error|Exception): .*)$"
"""A reason in the log in which Slurm keeps a job's output."""
SLURM_STATE_HINTS = {
    "TIMEOUT": "at its time limit: raise it with --set-resources {rule}:runtime=MINUTES",
    "OUT_OF_MEMORY": "at its memory limit: raise it with --set-resources {rule}:mem_mb=MB",
    "CANCELLED": "by scancel or at the limit of the partition",
    "NODE_FAIL": "because its node failed: run the same command again",
}
"""Meanings of Slurm's states, with hints."""
SIGNAL = r"died with <Signals\.\w+: (\d+)>|returned non-zero exit status (1[3-5]\d)\b"
"""Snakemake's message on a script that a signal ended, or on its shell, which adds 128 to it."""
SIGNAL_HINTS = {
    signal.SIGKILL: " (out of memory?): try fewer --cores",
    signal.SIGTERM: " (by a user or the system): run the same command again",
    signal.SIGSEGV: ": a library crashed: run the same command again, and report it if it recurs",
}
"""Possible meanings of signals, with hints."""
STATUS_OF_NO_LOG = rf"\bexit status {os.EX_IOERR}\b"
NO_LOG = (
    "its log could not be written (disk full?), and the reason is printed only above: free some "
    "space, and run the same command again"
)
"""The reason of jobs that end with this exit status, see pendula/contract/log.py."""
NO_REASON = "no reason found: its log may be lost, or the system killed it (out of memory?)"


class Errors(logging.Handler):
    """Collects Snakemake's errors, which `--quiet` or a full disk may keep out of its own log."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.setFormatter(DefaultFormatter())
        self.text = ""

    def emit(self, record: logging.LogRecord) -> None:
        """Add a record to the text."""
        self.text += f"{self.format(record)}\n"


def causes_of_failures(errors: str) -> list[tuple[str, str]]:
    """Return the reason and the log of each failed job in the text of Snakemake's errors."""
    causes = {}
    for _, rule, details in re.findall(FAILED_JOB, errors):
        listed = re.search(r"(?m)^ +log: (.*?) \(check", details)
        if not listed or "jobid: " not in details:
            continue
        logs = listed[1].split(", ")
        reasons = [
            *_matches(logs[0], REASON_IN_LOG),
            *_reasons_of_slurm(rule, details, logs),
            *_reasons_of_executor(rule, errors),
        ]
        first_with_text = next((log for log in logs if _text_of(log).strip()), logs[0])
        causes[logs[0]] = (reasons or [NO_REASON])[0], first_with_text
    return list(causes.values())


def _reasons_of_slurm(rule: str, details: str, logs: list[str]) -> list[str]:
    """Return what Slurm reports: a rejected request, a limit, or an error in a job's output."""
    state = re.search(r"SLURM status is: '(\w+)", details)
    job = re.search(r"SLURM-job '(\S+)'", details)
    reasons = re.findall(r"(?m)(sbatch: error: .*?)'?$", details)
    if hint := SLURM_STATE_HINTS.get(state[1]) if state else None:
        reasons.append(f"Slurm ended job {job[1]} ({state[1]}) {hint.format(rule=rule)}")
    reasons += [reason for log in logs[1:] for reason in _reasons_of_signals(_text_of(log))]
    reasons += [reason for log in logs[1:] for reason in _matches(log, REASON_OF_SLURM)]
    return reasons + ([f"Slurm: job {job[1]} is {state[1]}"] if state and job else [])


def _reasons_of_executor(rule: str, errors: str) -> list[str]:
    """Return what the executor or Snakemake reports on a job that a signal ended."""
    forked = re.findall(rf"(?m)^forked: rule {re.escape(rule)} failed: (.*)$", errors)
    numbers = [number for line in forked for number in re.findall(r"by signal (\d+)", line)]
    in_forks = _reasons_of_signals("\n".join(forked)) + _hints_on_signals(numbers)
    return in_forks + forked + _reasons_of_signals(errors)


def _reasons_of_signals(text: str) -> list[str]:
    """Return NO_LOG if a job could not write its log, and a line on each signal that ended one."""
    no_log = [NO_LOG] if re.search(STATUS_OF_NO_LOG, text) else []
    ends = re.findall(SIGNAL, text)
    return no_log + _hints_on_signals(number or int(status) - 128 for number, status in ends)


def _hints_on_signals(numbers: Iterable[str | int]) -> list[str]:
    """Return a line on each signal, given by its number."""
    signals = (signal.Signals(int(number)) for number in numbers)
    return [f"it was killed by {each.name}" + SIGNAL_HINTS.get(each, "") for each in signals]


def _matches(path: str, pattern: str) -> list[str]:
    return re.findall(pattern, _text_of(path))


def _text_of(path: str) -> str:
    """Return the text of a file, or an empty text if there is no file."""
    if not os.path.exists(path):
        return ""
    return Path(path).read_text(encoding="utf-8", errors="replace")
