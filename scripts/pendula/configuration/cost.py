"""What a run will take, estimated before it starts, so that one without end is refused by its key.

The cost of a run is the number of its steps times that of its sites. The number of steps follows
from the fastest rate at which the data turn, and from the tolerance by the order of the method.
Where the chain is unstable the data grow, and turn faster: they count as if they had grown to the
size at which growth ends. The constants fit the speeds that were measured (tests/baseline/speed),
and a test asks that every estimate is within a factor of three of what was measured.
"""

from collections.abc import Callable, Iterable, Mapping
from math import inf
from typing import NamedTuple

from latticode.equations.model import Model
from latticode.simulation.feasibility import Obstacle

HOUR, YEAR, GIGABYTE = 3600.0, 365.25 * 24 * 3600.0, 1e9
WORTH_SAYING = 180.0
"""Seconds: a run that will take longer says so before it starts."""


class Explicit(NamedTuple):
    """Steps = per_angle * angle * tolerance ** (-1 / order), and the seconds that each takes."""

    per_angle: float
    order: float
    seconds: float  # a step, whatever the chain
    site_seconds: float  # a step and a pair of pendula that is integrated
    site_bytes: float  # of the state and of the method's arrays, a pair


EXPLICIT = {
    "ode45": Explicit(0.18, 5, 2e-7, 3.8e-8, 700),
    "dop853": Explicit(0.11, 8, 1.2e-6, 7.5e-8, 800),
    "taylor": Explicit(0.16, 15, 6e-7, 1.5e-7, 1400),
}
ITERATED = {"seconds": 7e-8, "site_seconds": 3.5e-9}
"""Of a step of a scheme that is solved by iteration, beside its evaluations."""
EVALUATED = {"seconds": 7e-8, "site_seconds": 5.5e-9}
"""Of an evaluation of such a scheme."""
ITERATED_BYTES = 1000.0
SWING = 1.7
"""The rate of pendula in t, for the steps of the explicit methods: a sine has terms of its own."""
COMPOSED = {"seconds": 2e-6, "site_seconds": 3e-7}
"""Of a step of the composition of order eight."""
OUTPUT = {"seconds": 2e-7, "site_seconds": 3e-8}
"""Of an output: the state between two steps, its norms and its energy."""
OUTPUT_BYTES, MODULUS_BYTES, SITE_BYTES = 200.0, 40.0, 200.0
"""Of an output, of a modulus that is kept, and of a site of the whole chain in complex numbers."""
COARSEST, FINEST, REFINEMENT = 1e-4, 1e-15, 1e-2
"""The tolerances that `auto` tries, at most."""


class Cost(NamedTuple):
    """Seconds of one processor, and bytes of memory."""

    seconds: float
    memory: float

    def __str__(self) -> str:
        time = duration(self.seconds)
        return f"{'' if ' than ' in time else 'about '}{time} and {amount(self.memory)} of memory"

    def excess(self, limits: Mapping[str, float]) -> float:
        """Return this cost divided by the largest that `limits` allow: above 1 it is refused."""
        return max(
            self.seconds / (limits["hours"] * HOUR), self.memory / (limits["gigabytes"] * GIGABYTE)
        )


def estimate(problem: Mapping) -> Cost:
    """Return the cost of a problem, given as the plain values of a Problem.

    Nothing of the size of the chain is made; what overflows costs infinitely much.
    """
    solver, every = problem["solver"], problem["snapshot_every"]
    solvers = [solver]
    if solver["name"] == "auto":
        tolerances = auto_tolerances(solver["error"])
        solvers = [{"name": "taylor", "rtol": tolerance} for tolerance in tolerances]
    method = EXPLICIT.get(solvers[0]["name"])
    try:
        sites, pairs = 2 * problem["half_width"] + 1, integrated_pairs(problem)
        outputs = problem["end_time"] / problem["output_step"] + 1
        moduli = 2 * sites * (outputs / every) if every else 0.0
        seconds = sum(_solver_seconds(one, problem, pairs, outputs) for one in solvers)
        memory = (method.site_bytes if method else ITERATED_BYTES) * pairs + SITE_BYTES * sites
        return Cost(seconds, memory + OUTPUT_BYTES * outputs + MODULUS_BYTES * moduli)
    except (OverflowError, ZeroDivisionError):
        return Cost(inf, inf)


def _solver_seconds(solver: Mapping, problem: Mapping, pairs: float, outputs: float) -> float:
    steps, evaluations = steps_of(solver, problem)
    if solver["name"] == "kahan_li":
        each = COMPOSED["seconds"] + COMPOSED["site_seconds"] * pairs
        return outputs * OUTPUT["seconds"] + steps * each
    seconds = outputs * (OUTPUT["seconds"] + OUTPUT["site_seconds"] * pairs)
    if solver["name"] in EXPLICIT:
        method = EXPLICIT[solver["name"]]
        return seconds + steps * (method.seconds + method.site_seconds * pairs)
    seconds += steps * (ITERATED["seconds"] + ITERATED["site_seconds"] * pairs)
    return seconds + evaluations * (EVALUATED["seconds"] + EVALUATED["site_seconds"] * pairs)


TIGHTEST = {"taylor": 1e-14, "dop853": 1e-13}
"""The tolerances of a second run, by which the first is checked."""
OF_TANGENTS = {"name": "dop853", "rtol": 1e-9}
"""The solver of tangent vectors."""


def other_than(solver: str) -> str:
    """Return the solver that runs a case again."""
    return "dop853" if solver in ("taylor", "auto") else "taylor"


def with_checks(problem: Mapping) -> Cost:
    """Return the cost of a user's case: of its run, and of the checks that own_cases makes of it.

    These are a second run, and of the amplitudes a tangent vector beside the solution; of pendula
    they are the amplitudes.
    """
    other = other_than(problem["solver"]["name"])
    keys = ("mu",) if "parameters" in problem else ("mu", "model")
    plain = {key: value for key, value in problem.items() if key not in keys}
    again = {"solver": {"name": other, "rtol": TIGHTEST[other]}, "snapshot_every": 0}
    if problem.get("mu"):
        rest = [plain | {"solver": {"name": "taylor", "rtol": TIGHTEST["taylor"]}}]
    else:
        rest = 2 * [plain | {"solver": OF_TANGENTS, "output_step": problem["end_time"]}]
    return sum_of([problem, {**problem, **again}, *(one | {"snapshot_every": 0} for one in rest)])


def sum_of(problems: Iterable[Mapping]) -> Cost:
    """Return the cost of problems that are run one after another."""
    costs = [estimate(problem) for problem in problems]
    return Cost(sum(one.seconds for one in costs), max(one.memory for one in costs))


def steps_of(solver: Mapping, problem: Mapping) -> tuple[float, float]:
    """Return the steps of a run and, for a scheme that is solved by iteration, the evaluations."""
    span, rate = problem["end_time"], fastest_rate(problem)
    if solver["name"] in EXPLICIT:
        method = EXPLICIT[solver["name"]]
        tolerance = max(solver["rtol"], 1e-17) ** (-1.0 / method.order)
        return max(1.0, method.per_angle * rate * span * tolerance), 0.0
    if solver["name"] == "kahan_li":
        mu = problem.get("mu")
        fast = 2.0 / (mu * mu) if mu else 1.0
        return span * fast / min(solver["step"], problem["output_step"] * fast), 0.0
    step = min(solver["step"], problem["output_step"])
    while rate * step > 2.0:  # it is halved until the iteration contracts
        step *= 0.5
    return span / step, span / step * _iterations(rate * step, solver)


def _iterations(angle: float, solver: Mapping) -> float:
    """Return how often a step is iterated from a guess of the sixth order."""
    error = max(1e-30, (0.5 * angle) ** 6)
    count = 1.0
    while error > solver["tolerance"] and count < solver["iterations"]:
        error *= max(1e-3, min(0.9, 0.5 * angle))
        count += 1.0
    return count


def fastest_rate(problem: Mapping) -> float:
    """Return the rate at which the data turn: of linear waves, and of the largest amplitude.

    Small data of an unstable chain grow until the cubic terms turn them as fast as the linear ones.
    The chain at rest is unstable where the frequency of a wave is less than twice the drive.
    Pendula swing at a rate of 1 in t, whatever their slow motion does.
    """
    peak = max(max(map(abs, values)) for values in problem["initial"].values())
    if "parameters" in problem:
        model = problem["model"]
        model = Model.of_plain(model) if isinstance(model, Mapping) else model
        return model.rate(problem["parameters"], peak)
    if problem.get("mu"):
        mu = problem["mu"]
        return (SWING + 2.0 * mu * peak) * 2.0 / (mu * mu)
    omega, gamma, epsilon = problem["omega"], abs(problem["gamma"]), problem["epsilon"]
    ends = omega, omega - 4.0 * epsilon
    waves = max(map(abs, ends))
    slowest = 0.0 if min(ends) <= 0 <= max(ends) else min(map(abs, ends))
    cubic = 0.5 * peak * peak
    if gamma > 0.0 and peak > 0.0 and slowest < 2.0 * gamma:
        cubic = max(cubic, waves + 2.0 * gamma)
    return waves + gamma + 3.0 * cubic


def integrated_pairs(problem: Mapping) -> float:
    """Return the pairs of pendula that are integrated: half of a chain if the data are even.

    Where A = B only one component is, which counts half.
    """
    initial, half_width = problem["initial"], problem["half_width"]
    if "parameters" in problem:
        return (2 * half_width + 1) * 0.5 * max(map(len, initial.values()))
    even = all(initial.get(-site, (0, 0)) == pair for site, pair in initial.items())
    together = all(a == b for a, b in initial.values())
    return (half_width + 1 if even else 2 * half_width + 1) * (0.5 if together else 1.0)


def auto_tolerances(error: float) -> list[float]:
    """Return the tolerances that `auto` may try until two runs agree to `error`."""
    tried = [min(error, COARSEST)]
    while tried[-1] > FINEST:
        tried.append(max(REFINEMENT * tried[-1], FINEST))
    return tried


def find_excess(
    problem: Mapping, limits: Mapping[str, float], takes: Callable[[Mapping], Cost] = estimate
) -> Obstacle | None:
    """Return the key that makes a run longer or larger than is allowed, and what it would take.

    It is the key whose change to its value in PLAIN would save most. `takes` estimates the cost.
    """
    cost = takes(problem)
    if cost.excess(limits) <= 1.0:
        return None
    rest = {
        key: takes({**problem, **plain})
        for key, plain in PLAIN.items()
        if key != "mu" or "mu" in problem
    }
    what = "the run" if takes is estimate else "the run and its checks"
    return min(rest, key=lambda key: rest[key].excess(limits)), refusal(cost, limits, what)


def refusal(cost: Cost, limits: Mapping[str, float], what: str = "the run") -> str:
    """Return the words for a run that costs more than is allowed."""
    over_time = cost.seconds > limits["hours"] * HOUR
    name, unit = ("hours", "h") if over_time else ("gigabytes", "GB")
    allowed = f"limits.{name} allows {limits[name]:g} {unit}"
    return f"{what} would take {cost}, and {allowed}; make it smaller, or raise the limit"


PLAIN = {
    "half_width": {"half_width": 30},
    "output_step": {"output_step": 0.025},
    "end_time": {"end_time": 50.0},
    "snapshot_step": {"snapshot_every": 0},
    "omega": {"omega": 1.0},
    "epsilon": {"epsilon": 1.0},
    "gamma": {"gamma": 1.0},
    "initial": {"initial": {0: (1.0, 0.1)}},
    "mu": {"mu": 0.1},
    "solver": {"solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}},
}
"""Ordinary values, at which a run is short, of the keys that decide a cost."""


def duration(seconds: float) -> str:
    """Return a time in words, of one or two digits."""
    units = {"second": 1.0, "minute": 60.0, "hour": HOUR, "day": 24 * HOUR, "year": YEAR}
    if seconds >= 1e6 * YEAR:
        return "more than a million years"
    if seconds < 1.0:
        return "less than a second"
    name, size = [unit for unit in units.items() if seconds >= unit[1]][-1]
    count = max(1, round(seconds / size))
    return f"{count} {name}{'s' * (count > 1)}"


def amount(size: float) -> str:
    """Return an amount of memory in words."""
    if size >= 1e18:
        return "more than a million terabytes"
    for unit, scale in (("TB", 1e12), ("GB", 1e9)):
        if size >= scale:
            digits = ".2g" if size < 100 * scale else ".0f"
            return f"{size / scale:{digits}} {unit}"
    return f"{max(1, round(size / 1e6))} MB"
