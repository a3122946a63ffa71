"""The cost of large computations: surveys of many runs, and one very long chain.

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
from latticode.simulation.survey_runs import MANY, run_survey
from pendula.notebook import Case
from pendula.problem import PaperProblem

from .cost import noisy_chain
from .peers_in_python import survey_by_heyoka

WRITTEN = Path(__file__).with_name("scale.json")
HALF_CHAIN, END_TIME = 500_000, 10.0
RUNS, PEER_RUNS = 100_000, 1024
ALONE, IN_BATCHES = 960, 3200
"""Numbers of runs in the surveys of chains of several half-widths: one below MANY, one above."""
HALF_WIDTHS = (1, 2, 5, 15)


def survey(runs: int = RUNS) -> dict[str, float]:
    """Return the cost of a map of the paper's chain over Omega and A_0."""
    problem = chain_of_survey()
    milliseconds_a_run(problem, PEER_RUNS)  # compiles
    return {
        "runs": runs,
        "half_width": 30,
        "end_time": 50,
        "milliseconds_a_run": milliseconds_a_run(problem, runs),
    }


def milliseconds_a_run(problem: PaperProblem, runs: int) -> float:
    """Return the processor time of a run in a map of so many runs."""
    plan = Survey(axes_of_map(runs), ("max_l2", "mean_l2"), (10.0, 50.0))
    _, seconds = timed(lambda: run_survey(problem, plan))
    return 1e3 * seconds / runs


def surveys() -> dict[str, list]:
    """Return the cost of a run alone, and in a batch, in surveys of short chains."""
    assert ALONE < MANY <= IN_BATCHES
    rows = []
    for half_width in HALF_WIDTHS:
        problem = chain_of_survey().changed(half_width=half_width)
        rounds = [
            [milliseconds_a_run(problem, runs) for runs in (ALONE, IN_BATCHES)]
            for _ in range(4)  # the first round compiles
        ]
        rows.append([problem.sites, *np.median(rounds[1:], axis=0)])
    return {"rows": rows}


def survey_by_peer() -> dict[str, float]:
    """Return the time of heyoka in batches, without norms, over ours for a map of fewer runs."""
    omega, amplitude = map(np.ravel, np.meshgrid(*axes_of_map(PEER_RUNS).values()))
    milliseconds = 1e3 * survey_by_heyoka(chain_of_survey(), omega, amplitude) / PEER_RUNS
    ours = survey(PEER_RUNS)["milliseconds_a_run"]
    return {"runs": PEER_RUNS, "milliseconds_a_run": milliseconds, "ratio": milliseconds / ours}


def chain_of_survey() -> PaperProblem:
    case = Case(omega=-4, half_width=30, end_time=50)
    return case.kind.of(case.problem())


def axes_of_map(runs: int) -> dict[str, np.ndarray]:
    """Return the axes of a map of `runs` runs: 32 amplitudes for each Omega."""
    return {
        "omega": np.linspace(-6, 6, runs // 32),
        "initial.0.0": np.linspace(0.1, 2.0, 32),
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


JOBS = {
    "survey": (survey,),
    "surveys": (surveys,),
    "heyoka": (survey_by_peer,),
    "dop853": (chain, "dop853"),
    "taylor": (chain, "taylor"),
}


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
