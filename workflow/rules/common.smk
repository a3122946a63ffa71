# What the rules share: the validated configuration, the code records, the environment of jobs.
import atexit
import json
import os
import sys
from pathlib import Path

from snakemake.logging import logger
from snakemake.persistence import PersistenceBase

if sys.version_info < (3, 11):
    logger.error(f"this project needs Python 3.11 or newer, and this is {sys.version.split()[0]}")
    raise SystemExit(1)
sys.path[:0] = [f"{workflow.basedir}/{part}" for part in ("workflow", "scripts", "")]

import code_records
import file_times
import warm
from stop import stop

# Snakemake would import pandas, for a fifth of a second, to ask of each parameter whether it is a
# table of pandas. None is.
PersistenceBase._serialize_param_pandas = PersistenceBase._serialize_param_builtin

if not os.access(".", os.W_OK):
    stop(
        f"{os.getcwd()} is read-only, and Snakemake keeps notes there even of a dry run: name a "
        "folder that you may write to, by --directory"
    )
# Calls that only look write nothing to results/. Snakemake says of dry runs that they are such calls,
# and of no other, so that the options of the others are listed.
LOOKS = {
    "-l",
    "--list",
    "--list-rules",
    "--lt",
    "--list-target-rules",
    "--lint",
    "--dag",
    "--rulegraph",
    "--filegraph",
}
LOOKS |= {"-S", "--summary", "-D", "--detailed-summary", "--unlock"}
code_records.only_looks = workflow.output_settings.dryrun or bool(LOOKS & set(sys.argv))
RESULTS = Path("results").absolute()
FOLDERS = [
    "archive",
    "breathers",
    "certified",
    "checks",
    "claims",
    "code",
    "figure_diff",
    "figures",
    "kernels",
]
FOLDERS += [
    "kept",
    "logs",
    "own",
    "pendula",
    "speed",
    "sweeps",
    "tables",
    "trajectories",
    "truth",
    "unbounded",
]
for path in [RESULTS, *(RESULTS / name for name in FOLDERS)]:
    if path.is_file():
        stop(f"{path} is a file, and results need a folder of this name: move the file away")
    if path.is_symlink() and not path.exists():
        stop(f"{path} is a link to {os.readlink(path)}, which is not there: make it, or mount it")
    if path.exists() and not os.access(path, os.W_OK) and not code_records.only_looks:
        stop(f"{path} is read-only: make it writable, or name another folder by --directory")
file_times.restore(RESULTS)
RUNS = not code_records.only_looks and workflow.exec_mode.name == "DEFAULT"
if RUNS:
    atexit.register(file_times.keep, RESULTS)

# Jobs find the library and the benchmarks, and use one thread each, since they run in parallel.
os.environ.update(
    PYTHONPATH=os.pathsep.join([f"{workflow.basedir}/scripts", workflow.basedir]),
    OMP_NUM_THREADS="1",
    OPENBLAS_NUM_THREADS="1",
    MKL_NUM_THREADS="1",
)
# It imports what jobs need, while what stands below is read.
IMPORTED = warm.begin() if RUNS else None

from benchmarks.problems import REGIMES
from code_records import (
    code,
    committed,
    copies,
    is_committed,
    kept,
    records,
    was_made,
    whole_project,
)
from order import begin_at_once, put_in_order
from pendula import __version__
from pendula.configuration.files import ConfigurationError, gather
from pendula.configuration.messages import STUDIES, load, require
from pendula.configuration.paper import ENCLOSED, concerning, differences, paper, reason
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS
from pendula.problem import Constants, name_window
from pendula.studies.certified.norm import NotDefiniteError, find_form
from pendula.studies.theory.settings import GROUPS, OBSERVED, WRONG
from pendula.configuration.values import Steps
from pendula.sources import SCRIPTS, digest_of_code
from pendula.sources import files_of as files_of_module
from progress import Run, expected, take_the_screen, what_it_takes
from targets import asked, faults_of_targets, list_targets, what_failed, where_to_look

SCREEN = take_the_screen(workflow.output_settings) if workflow.is_main_process else None

PAPER_SOLVERS = ["ode45", "crank_nicolson"]
COMPARED = [*PAPER_SOLVERS, "delfour_fortin_payre", "dop853"]  # beside the paper's claims on them
ALL_SOLVERS = [*COMPARED, "taylor"]  # that every case of the paper is integrated by

# The project's files, what the command line gives by --configfile, and --config over all. They are
# read anew, since Snakemake takes the last of two equal keys in silence, and merges initial data.
CONFIG_FILES = [f"{workflow.basedir}/config/{name}.yaml" for name in ("config", *STUDIES)]
try:
    # Options of a single call, by --config alone: the baseline to compare with, whether any bits
    # will do, and what of a run to accept. In a file they would send a run's results elsewhere.
    OPTIONS = dict.fromkeys(("baseline", "bits", "accept"))
    given = dict(workflow.config_settings.config)
    OPTIONS |= {name: given.pop(name) for name in OPTIONS if name in given}
    for name in OPTIONS:
        config.pop(name, None)
    config.update(gather([*CONFIG_FILES, *workflow.overwrite_configfiles], given))
    SETTINGS = load(config)
    require(SETTINGS, PAPER_CASES, PAPER_SWEEPS, ALL_SOLVERS)
except ConfigurationError as error:
    stop(error)
if workflow.is_main_process:
    for sentence in SETTINGS.long_runs():
        logger.info(sentence)

DIFFERS = differences(json.loads(SETTINGS.model_dump_json()))  # from what the claims are about
ENSEMBLE_CASES = SETTINGS.chaos.ensembles.cases
ENSEMBLE_SWEEPS = list(SETTINGS.chaos.ensembles.sweeps)
OWN_CASES = [case for case in SETTINGS.cases if case not in PAPER_CASES]
OWN_SWEEPS = [sweep for sweep in SETTINGS.sweeps if sweep not in PAPER_SWEEPS]
SPEED_FIGURES = [*(f"speed_{regime}" for regime in REGIMES), "cost_growth"]
SOLVER_CHECKS = ["solvers", "second_solver", "trust"]
CHAOS_CHECKS = [
    *("lyapunov", "symmetry", "ensembles", "ensembles_uneven", "ensemble_runs"),
    *("members", "lifetimes"),
]
CHECKS = [*(name for group in GROUPS.values() for name in group), *OBSERVED]


def one_of(names):
    return "|".join(names) or "(?!)"  # an empty pattern would match any name, this one matches none


def kernels(*solvers):
    compiled = ["taylor" if solver == "auto" else solver for solver in solvers]
    return [f"results/kernels/{name}.txt" for name in compiled]


def own_kernels(case, solver=None):
    """Return the kernels that a case of one's own waits for.

    Those of the pendula are compiled by the first job that needs them, and others wait for it.
    """
    given = SETTINGS.cases[case]
    return [] if given.model == "pendula" else kernels(solver or given.solver.name)


def references(*cases):
    return [committed(f"tests/baseline/reference/{case}.nc") for case in cases]


def by_solvers(stem, solvers):
    return [f"{stem}.{solver}.nc" for solver in solvers]


def own_sweep_solver(wildcards):
    return SETTINGS.swept_problem(wildcards.sweep)["solver"]["name"]


def drawn_windows(sweep):
    drawn = SETTINGS.sweeps[sweep].drawn
    return {"text_window": name_window(drawn.max), "caption_window": name_window(drawn.mean)}


def reference_problem(case):
    sweeps = [SETTINGS.sweeps[name] for name in PAPER_SWEEPS]
    drawn = [sweep.drawn for sweep in sweeps if sweep.case == case]
    ends = [end for windows in drawn for _, end in (windows.max, windows.mean)]
    return SETTINGS.problem(case, end_time=max([SETTINGS.cases[case].end_time, *ends]))


FIGURE_KINDS = {"png": "png", "pdf": "pdf", "data": "nc", "description": "json"}


def figure(name):
    return {key: f"results/figures/{name}.{kind}" for key, kind in FIGURE_KINDS.items()}


def files_of(stem):
    """Return all files of a figure."""
    return [f"{stem}.{kind}" for kind in FIGURE_KINDS.values()]


def digest(script):
    """Return a hash of a script below scripts/ with all that it imports."""
    return digest_of_code(SCRIPTS / script)


def function(*names):
    """Return dotted names of functions, and a hash of their code: what a job calls."""
    files = [file for name in names for file in files_of_module(name.rpartition(".")[0])]
    return [*names, digest_of_code(*files)]


def values_of(part, *names):
    """Return the settings of these names, or all but those of a longer study, as plain values."""
    plain = part.model_dump()
    chosen = names or [name for name in plain if name != "long"]
    found = {name: getattr(part, name) for name in chosen}
    return {k: one.values if isinstance(one, Steps) else plain[k] for k, one in found.items()}


def sized(part, *names):
    """Return these settings for a rule that makes a longer study where its wildcard `size` says so."""
    return lambda wildcards: values_of(part.long if wildcards.size else part, *names)


def run_of(case, tolerance, solver="taylor", **changes):
    """Return a case as a study runs it, as plain values."""
    solver = {"name": solver, "rtol": tolerance, "atol": tolerance}
    return {**SETTINGS.problem(case), "solver": solver, "snapshot_every": 0, **changes}


pathvars:
    logs="<results>/logs",
    size="{size,(long/)?}",  # of a longer study, which lies in a folder of its own
