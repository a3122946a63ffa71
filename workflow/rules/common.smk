# Shared by all rules: the validated configuration, and functions for names of files, values and hashes. These
# functions are in scripts/pendula/workflow, with tests.
import atexit
import gc
import json
import os
import sys
from functools import partial
from importlib.metadata import version
from pathlib import Path

# Searching for reference cycles, during the run and at exit, would take 0.3 s and find few.
gc.set_threshold(100_000)
atexit.register(gc.freeze)

import pendula
from benchmarks.problems import REGIMES
from latticode.configuration.files import ConfigurationError
from latticode.integrators.methods import METHODS
from latticode.kernels import DISABLED
from latticode.kernels.sources import ROOTS, digest_of
from pendula.configuration.messages import load, require
from pendula.configuration.paper import concerning, constants_differ, differences, reason
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS
from pendula.contract.arguments import name_of
from pendula.workflow import files as file_names
from pendula.workflow import options, report_labels
from pendula.workflow.code import code_of_jobs, committed, function, script_digest
from pendula.workflow.failures import Errors, causes_of_failures
from pendula.workflow.files import (
    FIGURE_KINDS,
    PAPER_FIGURES,
    any_of,
    checks,
    chunks_in,
    datasets,
    figure_files,
    kernels,
    kernels_for,
    own_files,
    process_of_survey,
    runs_by,
)
from pendula.workflow.ledger import datasets_of_claims, modules_of, parts_of_ledger
from pendula.workflow.refusals import Refusals
from pendula.workflow.resources import cost_of_study, long_study, resources_for
from pendula.workflow.values import by_size, section_of_size, values_of, without_solver
from replication.archive.contents import code_files
from replication.article.quoted import copy_of
from snakemake.logging import logger

PROJECT = Path(str(workflow.current_basedir)).parents[1]
REFUSALS = Refusals(workflow)
stop, stopping = REFUSALS.stop, REFUSALS.stopping
REFUSALS.refuse_other_copies(PROJECT, pendula)
REFUSALS.refuse_read_only_folder()
REFUSALS.refuse_full_disk()
REFUSALS.refuse_storage()
if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
    stop(DISABLED)

# The environments that conda makes for jobs do not contain the project's packages.
if workflow.deployment_settings.deployment_method:
    os.environ.update(PYTHONPATH=os.pathsep.join(dict.fromkeys(map(str, ROOTS.values()))))
# Jupyter exports its own backend of matplotlib, which fails where it is not installed. If the variable is unset
# it stays unset: otherwise the process that forks jobs would have to import everything again.
if "MPLBACKEND" in os.environ:
    os.environ.update(MPLBACKEND="agg")

# Solvers of every case of the paper; the first three are the paper's.
ALL_SOLVERS = ["ode45", "crank_nicolson", "delfour_fortin_payre", "dop853", "taylor"]
COMPILED = [*ALL_SOLVERS, "ode45_real"]  # ode45_real has the error norm of real unknowns

given = workflow.config_settings
try:
    OPTIONS = options.take_options(config, given.config)
    config.update(
        options.read_configuration(PROJECT, workflow.overwrite_configfiles, given.config_args or ())
    )
    SETTINGS = load(config)
    require(SETTINGS, PAPER_CASES, PAPER_SWEEPS, ALL_SOLVERS)
except ConfigurationError as error:
    stop(error)
if workflow.is_main_process:
    for sentence in SETTINGS.long_runs():
        logger.info(sentence)

# Differences from the configuration that the claims are about
DIFFERS = differences(json.loads(SETTINGS.model_dump_json()))
OWN_CASES = [case for case in SETTINGS.cases if case not in PAPER_CASES]
OWN_SURVEYS = list(SETTINGS.surveys)
OWN_SPECTRA, OWN_SECTIONS = list(SETTINGS.spectra), list(SETTINGS.sections)
OWN_SWEEPS = [sweep for sweep in SETTINGS.sweeps if sweep not in PAPER_SWEEPS]
SOLVER_CHECKS = ["solvers", "trust"]
CHAOS_CHECKS = ["lyapunov", "ensembles", "second_solver", "members", "lifetimes"]
THEORY_CHECKS = [
    "not_shown",
    "errata",
    "chart",
    "threshold",
    "sharpness",
    "chain_growth",
    "well_posed",
]
TRAJECTORIES = datasets("trajectories", *PAPER_CASES)
SWEEPS = datasets("sweeps", *PAPER_SWEEPS)
SECOND_SWEEPS = datasets("sweeps", "fig5_left.crank_nicolson", "fig6_left.crank_nicolson")

run_of = SETTINGS.run_of
differs_of = partial(file_names.differs_of, DIFFERS)


# The runs of a study are one job, or 200 with `--set-scatter runs=200`, for the cores of this machine or the nodes
# of a cluster. Existing chunks are reused, and the number of chunks changes no bit.
scattergather:
    **file_names.chunks_of_surveys(SETTINGS.surveys, workflow.resource_settings.overwrite_scatter),
    runs=1,


chunks_of = partial(file_names.chunks_of, gather)


pathvars:
    logs="<results>/logs",
    chunk=f"{{chunk,{file_names.CHUNK}}}",
    paper_case=f"{{case,{any_of(PAPER_CASES)}}}",
    own_case=f"{{case,{any_of(OWN_CASES)}}}",
    paper_sweep=f"{{sweep,{any_of(PAPER_SWEEPS)}}}",
    own_sweep=f"{{sweep,{any_of(OWN_SWEEPS)}}}",
    own_survey=f"{{survey,{any_of(OWN_SURVEYS)}}}",
    own_spectrum=f"{{spectrum,{any_of(OWN_SPECTRA)}}}",
    own_section=f"{{section,{any_of(OWN_SECTIONS)}}}",
    any_case=f"{{case,{any_of(SETTINGS.cases)}}}",
    any_sweep=f"{{sweep,{any_of(SETTINGS.sweeps)}}}",
    any_solver=f"{{solver,{any_of([*METHODS, 'auto'])}}}",
    size="{size,(long/)?}",  # longer studies have their own folder


ERRORS = Errors()
logger.addHandler(ERRORS)


def seen_from_outside(path):
    """Return a path relative to the user's folder; with --directory the run has another one."""
    return os.path.join(workflow.overwrite_workdir or "", path)


def failures_in_words():
    """Return two lines for each failed job: the reason, and the path of its log."""
    causes = causes_of_failures(ERRORS.text)
    return "\n".join(f"{why}\n  (more in {seen_from_outside(log)})" for why, log in causes)


def environment(name):
    """Return an input function for the file of a conda environment.

    Braces in the project's path are doubled, because Snakemake would read them as wildcards.
    """
    path = f"{PROJECT}/workflow/envs/{name}.yaml".replace("{", "{{").replace("}", "}}")
    return lambda wildcards: path


def figure_outputs(stem):
    """Return the files of a figure as outputs; `snakemake --report` shows the picture."""
    picture, *others = figure_files(stem)
    shown = report(
        picture,
        caption="../report/figure.rst",
        category="Figures",
        labels=report_labels.label_figure,
    )
    return [shown, *others]


def dataset_outputs(*paths):
    """Return the datasets of a rule as outputs; `snakemake --report` lists them by folder."""
    look = {
        "caption": "../report/dataset.rst",
        "category": "Datasets",
        "subcategory": report_labels.folder_of,
    }
    labels = [partial(report_labels.label_dataset, place=place) for place in range(len(paths))]
    return [report(path, labels=label, **look) for path, label in zip(paths, labels)]


def references(*names):
    """Return committed multiprecision references of cases."""
    return [committed(f"tests/baseline/reference/{name}.nc") for name in names]
