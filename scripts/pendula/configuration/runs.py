"""Checks of the many runs of a study: whether a solver can integrate them, and their total cost."""

from collections.abc import Iterator, Mapping
from math import sqrt
from typing import Any, NamedTuple

from latticode.configuration import cost
from latticode.configuration.cost import RunCost
from latticode.configuration.surveys import FARTHEST
from latticode.simulation.feasibility import Obstacle

from pendula.feasibility import find_fault
from pendula.problem import Constants

from .cost import estimate


class Runs(NamedTuple):
    """Problems as plain values, and the keys of the study that their errors are reported under.

    `many` is the key of the number or duration of the runs. If the unperturbed data cannot be
    integrated, the error is reported under `tolerance`; if only perturbed data cannot, under
    `perturbed`. Relative perturbations are normal draws times `size`.
    """

    many: str
    tolerance: str
    problems: list[dict[str, Any]]
    times: float = 1.0
    perturbed: str = ""
    size: float = 0.0

    def faults(self) -> Iterator[tuple[str, str]]:
        """Yield the first key that prevents a run from reaching its end, and the reason."""
        for problem in self.problems:
            if fault := fault_of(problem):
                yield self.many if fault[0] == "end_time" else self.tolerance, fault[1]
                return
            if self.size and (fault := fault_of(enlarged(problem, 1.0 + FARTHEST * self.size))):
                yield self.perturbed, f"is {self.size:g}: {fault[1]}"
                return

    def costs(self) -> list[RunCost]:
        """Return the cost of each problem at the root mean square of its perturbed initial data."""
        mean = sqrt(1.0 + 2.0 * self.size * self.size)
        return [estimate(enlarged(problem, mean)) for problem in self.problems]

    def total(self) -> RunCost:
        """Return the cost of all runs, one after another."""
        total = cost.total(self.costs())
        return total._replace(seconds=self.times * total.seconds)


def enlarged(problem: Mapping, factor: float) -> dict:
    """Return a problem with its initial data multiplied by a factor."""
    initial = problem["initial"].items()
    return {**problem, "initial": {site: tuple(factor * z for z in data) for site, data in initial}}


def fault_of(problem: Mapping) -> Obstacle | None:
    """Return the key that prevents a problem's integration to its end and the reason, or None."""
    amplitudes = [z for data in problem["initial"].values() for z in data]
    peak = max(max(abs(z.real), abs(z.imag)) for z in amplitudes)
    constants, solver = Constants.of(problem), problem["solver"]
    return find_fault(constants, peak, problem["end_time"], solver, problem.get("mu"))
