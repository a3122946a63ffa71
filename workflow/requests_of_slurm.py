"""Requests that Slurm would keep in its queue for ever: of more time than a partition allows."""

import subprocess
from collections.abc import Iterable

PARTITIONS = ("sinfo", "--noheader", "--format", "%P|%l")
"""The command that lists each partition with its limit; an asterisk marks the default one."""


def never_started(requests: Iterable[tuple[str, str | None, int | None]], said: str) -> list[str]:
    """Return a sentence for each rule that asks for more minutes than its partitions allow.

    A request is a rule, its partitions if it names any, and its minutes; `said` is what sinfo says.
    """
    limits = _limits(said)
    longest = {}
    for rule, partitions, minutes in requests:
        named = str(partitions).split(",") if partitions else [""]
        known = [limits[name] for name in named if name in limits]
        if known and (minutes or 0) > max(known):
            _, before, _ = longest.get(rule, ("", 0, 0))
            longest[rule] = ",".join(filter(None, named)), max(minutes, before), max(known)
    return [
        f"{rule} asks for {minutes} minutes, and the partition {name or 'that is the default'} of "
        f"Slurm allows {most:g}, so that its job would wait for ever: ask for less by "
        f"--set-resources {rule}:runtime={most:.0f}, or for another partition by "
        f"--set-resources {rule}:slurm_partition=NAME"
        for rule, (name, minutes, most) in longest.items()
    ]


def partitions_of_slurm() -> str:
    """Return what sinfo says, or nothing where it cannot be asked: then sbatch will tell why."""
    return subprocess.run(PARTITIONS, capture_output=True, text=True, check=False).stdout


def _limits(said: str) -> dict[str, float]:
    """Return the minutes that each partition allows, the default one also without its name."""
    found = {}
    for line in said.splitlines():
        name, _, limit = line.strip().partition("|")
        found[name.removesuffix("*")] = _minutes(limit)
        if name.endswith("*"):
            found[""] = _minutes(limit)
    return found


def _minutes(limit: str) -> float:
    """Return a time as Slurm prints it, [[DAYS-]HOURS:]MINUTES:SECONDS, or infinity."""
    days, _, clock = limit.rpartition("-")
    parts = clock.split(":")
    if not all(part.isdigit() for part in parts):
        return float("inf")  # infinite, UNLIMITED, n/a
    hours, minutes, seconds = map(int, ["0", "0", *parts][-3:])
    return 1440 * int(days or 0) + 60 * hours + minutes + seconds / 60
