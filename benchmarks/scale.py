"""The cost of large computations: a survey of many runs, and one very long chain.

They take minutes and gigabytes, so no rule runs them. `python -m benchmarks.scale` measures them
one after another on one core, each in a process of its own, and writes benchmarks/scale.json, which
docs/source quotes.
"""

import json
import resource
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from latticode.kernels.sources import describe_machine
from latticode.simulation.simulate import simulate
from latticode.simulation.survey import Survey
from latticode.simulation.survey_runs import run_survey
from pendula.notebook import Case

from .cost import noisy_chain

WRITTEN = Path(__file__).with_name("scale.json")
MAP = {"omega": np.linspace(-6, 6, 1000), "initial.0.0": np.linspace(0.1, 2.0, 100)}
HALF_CHAIN, END_TIME = 500_000, 10.0


def survey() -> dict[str, float]:
    """Return the cost of a map of the paper's chain over Omega and A_0."""
    case = Case(omega=-4, half_width=30, end_time=50)
    problem, plan = case.kind.of(case.problem()), Survey(MAP, ("max_l2", "mean_l2"), (10.0, 50.0))
    simulate(problem)  # compiles
    results, seconds = timed(lambda: run_survey(problem, plan))
    runs = results["max_l2"][..., 0].size
    return {
        "runs": runs,
        "half_width": 30,
        "end_time": 50,
        "milliseconds_a_run": 1e3 * seconds / runs,
    }


def chain(solver: str) -> dict[str, float]:
    """Return the cost of a long chain on which all sites move from the start."""
    simulate(noisy_chain(1001, solver))  # compiles
    long = noisy_chain(2 * HALF_CHAIN + 1, solver).changed(end_time=END_TIME, output_step=END_TIME)
    _, seconds = timed(lambda: simulate(long))
    return {
        "sites": long.sites,
        "end_time": END_TIME,
        "microseconds_a_site": 1e6 * seconds / long.sites / END_TIME,
    }


JOBS = {"survey": (survey,), "dop853": (chain, "dop853"), "taylor": (chain, "taylor")}


def timed(action: Callable[[], Any]) -> tuple[Any, float]:
    """Return the result of `action()`, and its processor time in seconds."""
    start = process_time()
    return action(), process_time() - start


def measured(measure: Callable[..., dict], *arguments: Any) -> dict[str, Any]:
    """Return the figures of `measure(*arguments)`, the largest memory in MB, and the machine."""
    figures = measure(*arguments)
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return figures | {"megabytes": kilobytes / 1e3, "machine": describe_machine()}


def main(*names: str) -> None:
    """Measure the JOBS with these names, or all, and write the figures to scale.json."""
    figures = json.loads(WRITTEN.read_text(encoding="utf-8")) if WRITTEN.exists() else {}
    for name in names or JOBS:
        with ProcessPoolExecutor(1, get_context("spawn")) as pool:
            figures[name] = pool.submit(measured, *JOBS[name]).result()
        print(name, figures[name], flush=True)
        WRITTEN.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
