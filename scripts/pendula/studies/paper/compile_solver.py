"""Compile a solver's kernels once, so that parallel jobs find them in the cache."""

from pathlib import Path

from latticode.datasets import complete_or_absent
from latticode.equations.initial_values import on_sites
from latticode.integrators.methods import NAMED
from latticode.kernels.sources import digest_of_code
from latticode.simulation.simulate import simulate

from pendula.models import solvers
from pendula.problem import PaperProblem

CONTROLS = {"rtol": 1e-6, "atol": 1e-6, "step": 0.05, "tolerance": 1e-12, "iterations": 30}
"""A value for every control. Compiled code does not depend on these values: a change of a tolerance
needs no compilation, and reruns only the jobs that use it."""


def compile_solver(kernels: str, solver: str) -> None:
    """Compile the solver by a short run, then write a hash of its sources to the file `kernels`."""
    controls = {name: CONTROLS[name] for name in NAMED[solver].controls}
    problem = PaperProblem(
        parameters={"epsilon": 1.0, "gamma": 1.0, "omega": 0.0},
        half_width=1,
        boundary="dirichlet",
        initial=on_sites({0: (1.0, 0.1)}),
        end_time=0.1,
        output_step=0.05,
        solver={"name": solver, **controls},
    )
    simulate(problem)
    digest = digest_of_code(Path(solvers.__file__).resolve())
    with complete_or_absent(kernels) as partial:
        partial.write_text(f"{digest}\n", encoding="utf-8")
