"""Estimates of the time and memory of a run, so that an endless run is rejected before it starts.

The time is proportional to the number of steps times the number of sites. The number of steps
follows from the fastest rate of the initial data, the tolerance and the order of the method. The
constants are fitted to measured speeds (tests/baseline/speed); a test requires every estimate to be
within a factor of three of the measurement.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from math import inf
from typing import NamedTuple

from latticode.equations.ends import ANTIPERIODIC, PERIODIC, kind_of
from latticode.equations.model import Model
from latticode.integrators.families import first_tolerance, other_family, pair_of
from latticode.integrators.method import Demand, Obstacle
from latticode.integrators.methods import METHODS, methods_taking

HOUR, YEAR, GIGABYTE = 3600.0, 365.25 * 24 * 3600.0, 1e9
LONG_RUN = 180.0
"""Seconds: if a run is estimated to take longer, its cost is printed before it starts."""


OUTPUT = {"seconds": 2e-7, "site_seconds": 3e-8}
"""Cost of an output: interpolation of the state, norms and energy."""
OUTPUT_BYTES, MODULUS_BYTES, STATE_BYTES, SITE_BYTES = 200.0, 40.0, 60.0, 200.0
"""Bytes per output; per modulus stored alone; per modulus stored with both parts of its field; and
per site of the full chain in complex numbers."""


def span_of(problem: Mapping) -> float:
    """Return the duration of a run, in the time unit of the equations."""
    return problem["end_time"] - problem.get("start_time", 0.0)


Measure = Callable[[Mapping], Demand]
"""A function that returns the demand of a problem, given as plain values. Equations with known
bounds have their own function."""


class RunCost(NamedTuple):
    """The cost of a run: seconds on one processor, and bytes of memory."""

    seconds: float
    memory: float

    def __str__(self) -> str:
        return "{} and {} of memory".format(*self.words)

    @property
    def words(self) -> tuple[str, str]:
        """Time and memory as texts, such as "about 2 minutes" and "1 GB"."""
        time = duration(self.seconds)
        return f"{'' if ' than ' in time else 'about '}{time}", amount(self.memory)

    def excess(self, limits: Mapping[str, float]) -> float:
        """Return the larger of time and memory, each divided by its limit; above 1 is rejected."""
        return max(
            self.seconds / (limits["hours"] * HOUR), self.memory / (limits["gigabytes"] * GIGABYTE)
        )


def demand(problem: Mapping) -> Demand:
    """Return the demand of a problem, derived from its model.

    Only half of the chain is integrated if equations, parameters and data are even in n.
    """
    model, initial = problem["model"], problem["initial"]
    model = Model.of_plain(model) if isinstance(model, Mapping) else model
    peak = max(max(map(abs, values)) for values in initial.values())
    if not model.real:
        peak *= 0.5**0.5  # `rates_at` sets real and imaginary parts to it: their squares add up
    same_equations = model.even and not any(
        isinstance(value, list) for value in problem["parameters"].values()
    )
    even = same_equations and all(initial.get(-site) == values for site, values in initial.items())
    even = even and problem.get("site_count") is None
    sites = problem["half_width"] + 1 if even else _sites_of(problem)
    (rate,), pairs = model.rates_at(problem["parameters"], peak), 0.5 * len(model.fields) * sites
    return Demand(rate, pairs, in_parts=not (is_ring(problem) or model.matrices))


def is_ring(problem: Mapping) -> bool:
    """Return whether the ends of a problem's chain are joined."""
    return kind_of(problem["boundary"]) in (PERIODIC, ANTIPERIODIC)


def _sites_of(problem: Mapping) -> float:
    """Return the number of sites of the chain; it may be fractional for an infinite chain."""
    count = problem.get("site_count")
    return 2 * problem["half_width"] + 1 if count is None else count


def estimate(problem: Mapping, measure: Measure = demand) -> RunCost:
    """Return the cost of a problem, given as the plain values of a Problem.

    No array of the chain's size is allocated; the cost is infinite if a number overflows.
    """
    solver, every = problem["solver"], problem["snapshot_every"]
    try:
        needs, sites = measure(problem), _sites_of(problem)
        solvers = [solver]
        if solver["name"] == "auto":
            angle = needs.rate * span_of(problem)
            tolerance = first_tolerance(solver["error"], angle)
            solvers = [{"name": name, "rtol": tolerance} for name in pair_of(solvers_of(problem))]
        outputs = span_of(problem) / problem["output_step"] + 1
        fields = len(next(iter(problem["initial"].values())))
        bytes_of_value = STATE_BYTES if problem.get("keep") == "state" else MODULUS_BYTES
        snapshots = bytes_of_value * fields * sites * (outputs / every) if every else 0.0
        seconds = sum(_solver_seconds(method, problem, needs, outputs) for method in solvers)
        work = METHODS[solvers[0]["name"]].cost.memory(needs)
        memory = work + SITE_BYTES * sites
        return RunCost(seconds, memory + OUTPUT_BYTES * outputs + snapshots)
    except (OverflowError, ZeroDivisionError):
        return RunCost(inf, inf)


def _solver_seconds(solver: Mapping, problem: Mapping, needs: Demand, outputs: float) -> float:
    steps, evaluations = steps_of(solver, problem, needs)
    by_output = OUTPUT["seconds"] + OUTPUT["site_seconds"] * needs.pairs
    in_steps = METHODS[solver["name"]].cost.seconds(steps, evaluations, needs.pairs)
    return outputs * by_output + in_steps


OF_TANGENTS = {"name": "dop853", "rtol": 1e-9}
"""The solver of tangent vectors."""


def solvers_of(problem: Mapping) -> Collection[str]:
    """Return the solvers that can integrate the equations of a problem, given as plain values."""
    model = problem.get("model")
    model = Model.of_plain(model) if isinstance(model, Mapping) else model
    return methods_taking(model) if isinstance(model, Model) else METHODS


def runs_of_checks(problem: Mapping) -> list[Mapping]:
    """Return the problems that the checks integrate, as plain values: two runs and a tangent.

    Both runs store fields at the snapshots. The tangent is listed twice, because the solution is
    integrated with it.
    """
    second = other_family(problem["solver"]["name"], solvers_of(problem))
    second_run = {**problem, "solver": {"name": second, "rtol": METHODS[second].tightest}}
    without_snapshots = {**problem, "snapshot_every": 0}
    tangent = without_snapshots | {"solver": OF_TANGENTS, "output_step": span_of(problem)}
    return [problem, second_run, tangent, tangent]


KEPT_TO_COMPARE = 2.5
"""Memory of two runs whose fields are compared, divided by the memory of one run."""
LOCALISED = {"seconds": 3e-5, "bytes": 80.0}
"""Cost of a localised state and its exponents, per entry of a matrix. Newton's method solves with
this matrix while the coupling is turned on; then the eigenvalues of the matrix are computed."""
MOST_UNKNOWNS = 1000
"""The most real unknowns of a localised state that the checks look for."""


def with_checks(problem: Mapping, measure: Measure = demand) -> RunCost:
    """Return the cost of a run and all its checks, including the localised state."""
    runs = of_checked([estimate(run, measure) for run in [problem, *runs_of_checks(problem)]])
    unknowns = 4.0 * measure(problem).pairs  # two real numbers per field and site
    entries = unknowns**2 if unknowns <= MOST_UNKNOWNS else 0.0
    state = RunCost(LOCALISED["seconds"] * entries, LOCALISED["bytes"] * entries)
    return total([runs, state])


def of_checked(runs: Iterable[RunCost]) -> RunCost:
    """Return the total cost of runs, with memory to compare two runs as large as the first."""
    first, *_ = runs = list(runs)
    compared = first._replace(seconds=0.0, memory=KEPT_TO_COMPARE * first.memory)
    return total([*runs, compared])


def total(costs: Iterable[RunCost]) -> RunCost:
    """Return the cost of runs executed one after another."""
    costs = list(costs)
    return RunCost(sum(cost.seconds for cost in costs), max(cost.memory for cost in costs))


def steps_of(solver: Mapping, problem: Mapping, needs: Demand) -> tuple[float, float]:
    """Return the number of steps, and the evaluations per step if the method is implicit."""
    cost = METHODS[solver["name"]].cost
    return cost.steps(solver, needs, span_of(problem), problem["output_step"])


CHEAP_VALUES = {
    "half_width": {"half_width": 30},
    "sites": {"half_width": 30, "site_count": None},
    "output_step": {"output_step": 0.025},
    "end_time": {"start_time": 0.0, "end_time": 50.0},
    "snapshot_step": {"snapshot_every": 0},
    "initial": {"initial": {0: (1.0,)}},
    "solver": {"solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}},
}
"""Values that make a run short, for the keys that determine its cost."""


def find_excess(
    problem: Mapping,
    limits: Mapping[str, float],
    estimate_cost: Callable[[Mapping], RunCost] = estimate,
    cheap_values: Mapping[str, Mapping] = CHEAP_VALUES,
    subject: str = "the run",
) -> Obstacle | None:
    """Return (key, message) if a run exceeds the limits on time or memory, else None.

    The value of this key in `cheap_values` would lower the cost most. `estimate_cost` returns the
    cost of a problem, and `subject` names the run in the message.
    """
    cost = estimate_cost(problem)
    if cost.excess(limits) <= 1.0:
        return None
    costs = {key: estimate_cost({**problem, **values}) for key, values in cheap_values.items()}
    key = min(costs, key=lambda key: costs[key].excess(limits))
    return key, name_excess(cost, limits, subject)


def name_excess(cost: RunCost, limits: Mapping[str, float], subject: str = "the run") -> str:
    """Return the message for a run that exceeds the limits on time or memory."""
    over_time = cost.seconds > limits["hours"] * HOUR
    name, unit = ("hours", "h") if over_time else ("gigabytes", "GB")
    limit, (time, memory) = f"{limits[name]:g} {unit}", cost.words
    allowed = duration(limits["hours"] * HOUR)
    if over_time and time == f"about {allowed}":
        time = f"a little over {allowed}"
    elif memory == limit:
        memory = f"a little over {limit}"
    needs, advice = f"{time} and {memory} of memory", "make it smaller, or raise the limit"
    return f"{subject} would take {needs}, but limits.{name} allows {limit}; {advice}"


def duration(seconds: float) -> str:
    """Return a duration as text with one or two digits, such as "2 minutes"."""
    units = {"second": 1.0, "minute": 60.0, "hour": HOUR, "day": 24 * HOUR, "year": YEAR}
    if seconds >= 1e6 * YEAR:
        return "more than a million years"
    if seconds < 1.0:
        return "less than a second"
    name, size = [unit for unit in units.items() if seconds >= unit[1]][-1]
    count = max(1, round(seconds / size))
    return f"{count} {name}{'s' * (count > 1)}"


def amount(size: float) -> str:
    """Return an amount of memory as text, such as "1 GB"."""
    if size >= 1e18:
        return "more than a million terabytes"
    for unit, scale in (("TB", 1e12), ("GB", 1e9)):
        if size >= scale:
            digits = ".2g" if size < 100 * scale else ".0f"
            return f"{size / scale:{digits}} {unit}"
    return f"{max(1, round(size / 1e6))} MB"
