"""Speed against error for Newton's equations: all solvers that integrate them, and peers.

They are compared on the paper's regular cases, up to the same time and at equal errors.
"""

from collections.abc import Callable, Mapping

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.simulation.simulate import simulate
from pendula.problem import PaperProblem

from .contestants import SOLVERS, Contestant, compete, error_of
from .problems import until
from .work_precision import POINT_FIELDS, by_pair, by_point, name_contestants

MU, END_TIME, TARGET = 0.1, 1.0, 1e-10
"""Small parameter mu, slow time at the end, and error in rad at which solvers are compared."""
AGREED = 1e-12
"""Difference in rad below which two methods with small errors count as exact."""
OURS = {name: SOLVERS[name] for name in ("taylor", "dop853", "ode45", "kahan_li")}
FIELDS = POINT_FIELDS | {"error": ("error of an angle or a velocity, the largest", "rad")}


def as_pendula(problem: PaperProblem) -> PaperProblem:
    """Return the pendula of a case of the amplitudes, up to the end of the comparison."""
    return until(problem, END_TIME, model="pendula", mu=MU)


def exact_state(problem: PaperProblem) -> np.ndarray:
    """Return the angles and velocities at the end, on which two methods agree within AGREED.

    Raises RuntimeError if the methods do not agree.
    """
    tight = {"name": "taylor", "rtol": 1e-15, "atol": 1e-15}
    finals = [
        simulate(problem.changed(solver=solver)).final
        for solver in (tight, {"name": "kahan_li", "step": 0.05})
    ]
    if not error_of(*finals) < AGREED:
        raise RuntimeError(
            f"no exact state: two methods differ by {error_of(*finals):.1e} rad, not by less than"
            f" {AGREED:g} rad"
        )
    return finals[0]


def measure(
    problems: Mapping[str, PaperProblem],
    peers: Mapping[str, Contestant],
    report: Callable[[str], None],
) -> dict[str, Variable]:
    """Return the variables of the dataset; `problems` are cases of the amplitudes by name."""
    points, pairs = {}, {}
    for case, cases in problems.items():
        problem = as_pendula(cases)
        for contestant in OURS.values():  # compile now, outside of the timed runs
            contestant.prepare(until(problem, 1e-3))(contestant.accuracies[0])
        exact = exact_state(problem)
        points[case], pairs[case] = compete(
            problem, exact, TARGET, OURS, peers, lambda title, case=case: report(f"{case}: {title}")
        )
    return {
        "case": Variable(("case",), np.array(list(problems))),
        **name_contestants({**OURS, **peers}),
        **by_point(FIELDS, points),
        **by_pair(pairs, list(peers)),
    }
