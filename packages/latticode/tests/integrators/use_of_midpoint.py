"""Uses a solver named midpoint as users do, and prints what came of it as JSON."""

import json

import numpy as np
from latticode import Case, Model, abs2, check, lap, simulate
from latticode.configuration.cost import demand, steps_of
from latticode.configuration.files import ConfigurationError
from latticode.datasets.registry import SOLVER_NAMES
from latticode.drawing.style import COLOURS
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate as simulate_problem
from latticode.simulation.traced import TracedEquations
from scipy.integrate import solve_ivp

CHAIN = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
KEYS = {"model": CHAIN, "half_width": 2, "initial": {0: [1.2]}, "end_time": 5, "output_step": 0.5}


class TwoMethods(TracedEquations):
    """Equations that two methods integrate."""

    methods = ("dop853", "midpoint")


class ProblemOfTwo(Problem):
    @property
    def equations(self):
        return TwoMethods(self)


def true_final() -> np.ndarray:
    """Return the field at the end, by SciPy on plain NumPy."""

    def rate(t, u):
        padded = np.pad(u, 1)
        return -1j * (padded[2:] - 2 * u + padded[:-2] + np.abs(u) ** 2 * u)

    start = np.array([0, 0, 1.2, 0, 0], complex)
    return solve_ivp(rate, (0, 5), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]


def final_of(run) -> np.ndarray:
    real, imaginary = run["final"].sel(component="u").transpose("part", "site").values
    return real + 1j * imaginary


def fault_of(name: str) -> str:
    try:
        Case(**KEYS, solver=name)
    except ConfigurationError as error:
        return str(error)
    return ""


def main() -> dict:
    case = Case(**KEYS, solver="midpoint")
    run, entries = simulate(case), case.problem()
    auto = {"name": "auto", "error": 1e-3}
    by_error = simulate_problem(ProblemOfTwo.of(entries | {"solver": auto}))
    checks = check(case, run)
    return {
        "error": np.abs(final_of(run) - true_final()).max(),
        "controls": entries["solver"],
        "solver": run.attrs["solver"],
        "steps": float(run.attrs["steps"] + run.attrs["rejected_steps"]),
        "estimated_steps": steps_of(entries["solver"], entries, demand(entries))[0],
        "cost": str(case.cost(entries)),
        "agrees_with": by_error.solver["agrees_with"],
        "judge": checks.attrs["second_name"],
        "difference": float(checks["largest_difference"]),
        "label": SOLVER_NAMES["midpoint"],
        "has_colour": "midpoint" in COLOURS,
        "fault": fault_of("midpoin"),
    }


if __name__ == "__main__":
    print(json.dumps(main()))
