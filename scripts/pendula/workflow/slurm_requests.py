"""Requests of more time than a Slurm partition allows, which would stay in the queue for ever."""

import subprocess
from collections.abc import Iterable

SINFO = ("sinfo", "--noheader", "--format", "%P|%l")
"""The command that lists each partition with its limit; an asterisk marks the default one."""

Request = tuple[str, str | None, int | None]
"""The name of a rule, its partitions if it requests any, and its minutes."""


def requests_above_limits(requests: Iterable[Request], sinfo_output: str) -> list[str]:
    """Return a sentence for each rule that requests more minutes than its partitions allow."""
    limits = _limits_in(sinfo_output)
    longest: dict[str, tuple[str, float, float]] = {}
    for rule, partitions, minutes in requests:
        names = str(partitions).split(",") if partitions else [""]
        allowed = [limits[name] for name in names if name in limits]
        if allowed and (minutes or 0) > max(allowed):
            _, before, _ = longest.get(rule, ("", 0, 0))
            longest[rule] = ",".join(filter(None, names)), max(minutes, before), max(allowed)
    return [
        f"{rule} requests {minutes} minutes, but Slurm's {names or 'default'} partition allows "
        f"only {limit:g}, so the job would never start: request less with "
        f"--set-resources {rule}:runtime={limit:.0f}, or another partition with "
        f"--set-resources {rule}:slurm_partition=NAME"
        for rule, (names, minutes, limit) in longest.items()
    ]


def partitions_of_slurm() -> str:
    """Return the output of sinfo. If it fails, return an empty text: sbatch reports the reason."""
    return subprocess.run(SINFO, capture_output=True, text=True, check=False).stdout


def _limits_in(sinfo_output: str) -> dict[str, float]:
    """Return the minutes that each partition allows. The default one also has an empty name."""
    limits = {}
    for line in sinfo_output.splitlines():
        name, _, limit = line.strip().partition("|")
        limits[name.removesuffix("*")] = _minutes(limit)
        if name.endswith("*"):
            limits[""] = _minutes(limit)
    return limits


def _minutes(limit: str) -> float:
    """Return a time as Slurm prints it, [[DAYS-]HOURS:]MINUTES:SECONDS, in minutes, or infinity."""
    days, _, clock = limit.rpartition("-")
    numbers = clock.split(":")
    if not all(number.isdigit() for number in numbers):
        return float("inf")  # infinite, UNLIMITED, n/a
    hours, minutes, seconds = map(int, ["0", "0", *numbers][-3:])
    return 1440 * int(days or 0) + 60 * hours + minutes + seconds / 60
