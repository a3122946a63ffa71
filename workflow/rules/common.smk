# What every rule needs: the validated configuration, the code records, and the environment of jobs.
import os
import sys

from snakemake.exceptions import WorkflowError

sys.path[:0] = [f"{workflow.basedir}/workflow", f"{workflow.basedir}/scripts"]

from code_records import code
from pendula.faults import ConfigurationError, load

# Jobs find the library and nothing of the user's: one thread each, since jobs run in parallel.
os.environ["PYTHONPATH"] = f"{workflow.basedir}/scripts"
for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

try:
    SETTINGS = load(config)
except ConfigurationError as error:
    raise WorkflowError(str(error)) from None

PAPER_SOLVERS = ["ode45", "crank_nicolson"]
ALL_SOLVERS = [*PAPER_SOLVERS, "dop853"]
PAPER_CASES = [f"fig{n}_{size}" for n in (2, 3, 4) for size in ("small", "large")]
PAPER_SWEEPS = [f"fig{n}_{side}" for n in (5, 6) for side in ("left", "right")]


def own_solver(problem):
    return problem["solver"]["name"]


def trajectory_problem(wildcards):
    return SETTINGS.problem(wildcards.case, wildcards.get("solver"))


def sweep_problem(wildcards):
    return SETTINGS.swept_problem(wildcards.sweep, wildcards.get("solver"))


def kernels_of_trajectory(wildcards):
    return f"results/kernels/{own_solver(trajectory_problem(wildcards))}.txt"


def kernels_of_sweep(wildcards):
    return f"results/kernels/{own_solver(sweep_problem(wildcards))}.txt"


def figure(name):
    return [f"results/figures/{name}.{kind}" for kind in ("png", "pdf", "nc")]
