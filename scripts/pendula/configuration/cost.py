"""Cost of a run of the paper's equations, estimated from their rates instead of a trace."""

from collections.abc import Mapping
from functools import partial

from latticode.configuration import cost
from latticode.configuration.cost import RunCost
from latticode.integrators.method import Demand
from latticode.integrators.methods import METHODS

from pendula.feasibility import clock_of

SWING = 1.7
"""The rate of pendula per unit of t that sets the steps of explicit methods; above the frequency 1
because of the terms of the sine."""
CHEAP_VALUES = cost.CHEAP_VALUES | {
    "omega": {"omega": 1.0},
    "epsilon": {"epsilon": 1.0},
    "gamma": {"gamma": 1.0},
    "initial": {"initial": {0: (1.0, 0.1)}},
}
OF_PENDULA = CHEAP_VALUES | {"mu": {"mu": 0.1}}
"""Values at which a run is short, by key; OF_PENDULA is for pendula."""


def demand(problem: Mapping) -> Demand:
    """Return the values that determine the cost of a problem of (4), or of (1) if `mu` is given."""
    mu = problem.get("mu")
    rate, pairs, clock = fastest_rate(problem), integrated_pairs(problem), clock_of(mu) if mu else 1
    return Demand(rate, pairs, clock, in_parts=not cost.is_ring(problem))


estimate = partial(cost.estimate, measure=demand)


def with_checks(problem: Mapping) -> RunCost:
    """Return the cost of a user's case: its run, and the runs of the checks in own_cases.

    The checks of pendula are two runs of them and one run of the amplitudes.
    """
    checks = cost.runs_of_checks(problem)
    if problem.get("mu"):
        amplitudes = {key: value for key, value in problem.items() if key not in ("mu", "model")}
        solver = {"name": "taylor", "rtol": METHODS["taylor"].tightest}
        checks = [*checks[:2], amplitudes | {"solver": solver, "snapshot_every": 0}]
    return cost.of_checked(map(estimate, [problem, *checks]))


def fastest_rate(problem: Mapping) -> float:
    """Return the fastest rate of the phases: of linear waves, and of the largest amplitude.

    On an unstable chain small data grow until the cubic terms are as large as the linear ones. The
    chain at rest is unstable if the frequency of a wave is less than twice the drive. Pendula swing
    at the rate 1 per unit of t, however slowly their amplitudes change.
    """
    peak = max(max(map(abs, values)) for values in problem["initial"].values())
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
    """Return the number of pairs that are integrated: half of the chain for even data.

    If A = B, only one component is integrated, and a pair counts half.
    """
    initial, half_width = problem["initial"], problem["half_width"]
    even = all(initial.get(-site, (0, 0)) == pair for site, pair in initial.items())
    together = all(a == b for a, b in initial.values())
    return (half_width + 1 if even else 2 * half_width + 1) * (0.5 if together else 1.0)
