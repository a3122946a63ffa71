"""Memory and time that a job requests from a cluster, from the estimate of its cost."""

import math
from collections.abc import Callable
from typing import Any

from latticode.configuration.cost import RunCost

START_MB, START_MINUTES = 1000, 15
"""Memory in MB and time in minutes for Python, imports and a compilation."""
SAFETY = 5
"""Factor on estimated times: they are right within a factor of three, and a node may be slower."""
SHORT, HOUR = RunCost(0.0, 0.0), RunCost(3600 / SAFETY, 0.0)
"""Costs of a job that requests only the start time above, and of one that adds an hour."""


def cost_of_study(wildcards: Any) -> RunCost:
    """Return the cost of a study: an hour if the wildcard `size` selects the longer one."""
    return HOUR if wildcards.size else SHORT


def resources_for(cost_of: Callable[[Any], RunCost]) -> dict[str, Callable]:
    """Return the resources of a job whose run is estimated to take `cost_of(wildcards)`."""

    def memory(wildcards: Any, attempt: int) -> int:
        return attempt * (START_MB + math.ceil(2e-6 * cost_of(wildcards).memory))

    def minutes(wildcards: Any, attempt: int) -> int:
        return attempt * (START_MINUTES + math.ceil(SAFETY * cost_of(wildcards).seconds / 60))

    return {"mem_mb": memory, "runtime": minutes}


def long_study(*_: Any) -> RunCost:
    """Return the cost of a longer study."""
    return HOUR
