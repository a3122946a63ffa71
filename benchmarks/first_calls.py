"""The cost of a first call: what a new model takes from the start of Python to the end of its run.

No rule runs this. `python -m benchmarks.first_calls` runs each case in new processes, each with an
empty cache of kernels, and writes benchmarks/first_calls.json, which docs/source quotes.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from time import process_time
from typing import Any

WRITTEN = Path(__file__).with_name("first_calls.json")
CASES = {
    "two fields": ("taylor", 2),
    "two fields, compiled before": ("taylor", 2),
    "two fields, DOP853": ("dop853", 2),
    "two fields, ode45": ("ode45", 2),
    "nine fields": ("taylor", 9),
    "the paper's equations": ("taylor", 0),
}
"""Solver and number of fields; the paper's equations have their own kernels."""
REPEAT = 3


def measured(name: str) -> dict[str, float]:
    """Return the processor time in s of the parts of a first call in this process."""
    from latticode import notebook  # noqa: F401
    from latticode.simulation import simulate

    solver, fields = CASES[name]
    seconds = Counter({"import": process_time()})
    case = case_of_fields if fields else paper_case
    problem = call_timed(seconds, "equations", prepared, case, solver, fields)
    count_compiler(seconds)
    simulate.simulate(problem)
    seconds["compiler"] -= seconds["LLVM"]
    total = process_time()
    return {**seconds, "other": total - seconds.total(), "total": total}


def prepared(make_case: Callable, solver: str, fields: int) -> Any:
    """Return a problem, whose kernels are written as text but not compiled."""
    case = make_case(solver, fields)
    problem = case.kind.of(case.problem())
    problem.equations.compiled(solver)
    return problem


def case_of_fields(solver: str, fields: int) -> Any:
    from latticode import Case, Model, abs2, lap

    def i_dt(p: Any, *u: Any) -> list:
        return [lap(a) + p.k * u[n - 1] + abs2(a) * a for n, a in enumerate(u)]

    names = [f"u{n}" for n in range(fields)]
    model = Model(fields=names, parameters={"k": 0.3}, i_dt=i_dt)
    start = {0: [1.0] * fields}
    return Case(model=model, half_width=10, initial=start, end_time=1, solver=solver)


def paper_case(solver: str, _: int) -> Any:
    from pendula.notebook import Case

    return Case(omega=-4, half_width=10, end_time=1, solver=solver)


def call_timed(seconds: Counter, part: str, function: Callable, *arguments: Any) -> Any:
    """Return the result of a function, and add its processor time to a part."""
    start = process_time()
    result = function(*arguments)
    seconds[part] += process_time() - start
    return result


def count_compiler(seconds: Counter) -> None:
    """Add the times of all compilations from now on to `compiler`, those of LLVM also to `LLVM`."""
    from latticode.kernels.inside_numba import Kernel
    from llvmlite import binding

    for owner, method, part in (
        (Kernel, "compile", "compiler"),
        (binding.ModulePassManager, "run", "LLVM"),
        (binding.FunctionPassManager, "run", "LLVM"),
        (binding.ExecutionEngine, "finalize_object", "LLVM"),
    ):
        original = getattr(owner, method)

        def counted(*arguments: Any, original: Any = original, part: str = part) -> Any:
            return call_timed(seconds, part, original, *arguments)

        setattr(owner, method, counted)


def in_new_process(name: str) -> dict[str, float]:
    """Return what `measured` returns in a process with a cache of its own."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "LATTICODE_CACHE": folder}
        command = [sys.executable, "-m", __spec__.name, name]
        for _ in range(2 if "before" in name else 1):
            done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout)


def main() -> None:
    """Measure all cases in turn, and write the fastest process of each to first_calls.json."""
    from latticode.kernels.sources import describe_machine

    rounds = [{name: in_new_process(name) for name in CASES} for _ in range(REPEAT)]
    least = {
        name: min((times[name] for times in rounds), key=lambda times: times["total"])
        for name in CASES
    }
    figures = {"machine": describe_machine(), "seconds": least}
    WRITTEN.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main() if not sys.argv[1:] else print(json.dumps(measured(sys.argv[1])))
