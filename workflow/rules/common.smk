# What the rules share: the validated configuration and names of files.
import atexit
import gc
import json
import math
import os
import sys
from functools import cache
from pathlib import Path
from tempfile import TemporaryFile
from types import SimpleNamespace

from snakemake.logging import logger
from snakemake.settings.enums import Quietness

# Python searches all objects for garbage whenever many are new, and once more when it ends. Here it would
# find little, and the searches would take a third of a second.
gc.set_threshold(100_000)
atexit.register(gc.freeze)

PROJECT = Path(str(workflow.current_basedir)).parents[1]
LIBRARIES = [str(PROJECT / part) for part in ("packages/latticode", "scripts", "")]
sys.path[:0] = [f"{PROJECT}/workflow", *LIBRARIES]


PROBE = 100_000
"""Bytes that Snakemake's notes of a run take at least."""


def stop(reason):
    """Say why nothing runs, and end. Of an error, Snakemake would tell where in the rules it arose."""
    if Quietness.ALL in workflow.output_settings.quiet:  # which leaves out errors too
        print(reason, file=sys.stderr)
    logger.error(str(reason))
    raise SystemExit(1)


for folder in filter(os.path.exists, (".", ".snakemake")):
    if not os.access(folder, os.W_OK):
        stop(
            f"{os.path.abspath(folder)} is read-only, and Snakemake keeps notes there even of a dry "
            "run: name a folder that you may write to, by --directory"
        )

if workflow.is_main_process and not workflow.dryrun:
    try:
        with TemporaryFile(dir=".") as probe:
            probe.write(bytes(PROBE))
            probe.flush()
    except OSError as error:
        stop(f"{os.path.abspath('.')} takes no files ({error.strerror}): make room, and run again")

# Its pull request 3969 taught Snakemake to apply them to files, and left out where these are in a storage.
if provider := workflow.storage_settings.default_storage_provider:
    stop(
        f"--default-storage-provider {provider} does not work here, since Snakemake does not apply the "
        "pathvars of single rules there. Leave it out, and copy results/ to the storage afterwards"
    )

# Jobs find the library and the benchmarks. Jupyter sets its own backend of matplotlib for all that it starts,
# which fails where it is not installed; the variable is left alone if absent, so that no import is repeated.
os.environ.update(PYTHONPATH=os.pathsep.join(LIBRARIES))
if "MPLBACKEND" in os.environ:
    os.environ.update(MPLBACKEND="agg")

from reasons import Errors, why_jobs_failed
from requests_of_slurm import never_started, partitions_of_slurm

from benchmarks.problems import REGIMES
from pendula import __version__
from replication.archive.contents import code_files
from replication.article.quoted import copy_of
from latticode.configuration.cost import Cost
from latticode.configuration.files import ConfigurationError, gather, read_entries
from latticode.configuration.values import Steps
from pendula.configuration.messages import STUDIES, load, require
from pendula.configuration.paper import concerning, differences, paper, reason
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS
from latticode.simulation.problem import name_window
from pendula.problem import MODELS
from latticode.kernels import DISABLED
from latticode.kernels.sources import digest_of, digest_of_code, files_of_module, modules_of
from pendula.sources import SCRIPTS
from pendula.studies import files_with_prefix

if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
    stop(DISABLED)

# By these every case of the paper is integrated, the paper's own solvers first.
ALL_SOLVERS = ["ode45", "crank_nicolson", "delfour_fortin_payre", "dop853", "taylor"]
COMPILED = [*ALL_SOLVERS, "ode45_real"]  # with ode45 as it is for real unknowns

# The project's files, what the command line gives by --configfile, and --config over all. They are read
# here and by no `configfile:`, since Snakemake names no line of a file that is not YAML, takes the last
# of two equal keys in silence, and merges initial data.
CONFIG_FILES = [f"{PROJECT}/config/{name}.yaml" for name in ("config", *STUDIES)]
try:
    # Options of a single call, by --config alone: the baseline to compare with, whether any bits will do,
    # what of a run to accept, in how many parts to make many runs. In a file they would send results elsewhere.
    OPTIONS = {
        name: workflow.config_settings.config.get(name)
        for name in ("baseline", "bits", "accept", "chunks")
    }
    for name in OPTIONS:
        config.pop(name, None)
    # Snakemake itself takes the last of two equal keys here too, and 010 for ten
    entries = workflow.config_settings.config_args or ()
    given = read_entries(one for one in entries if one.partition("=")[0] not in OPTIONS)
    config.update(gather([*CONFIG_FILES, *workflow.overwrite_configfiles], given))
    SETTINGS = load(config)
    require(SETTINGS, PAPER_CASES, PAPER_SWEEPS, ALL_SOLVERS)
except ConfigurationError as error:
    stop(error)
if not str(OPTIONS["chunks"] or 1).isdecimal() or OPTIONS["chunks"] == 0:
    stop(f"--config chunks={OPTIONS['chunks']}: give a whole number of jobs, as in chunks=8")
if workflow.is_main_process:
    for sentence in SETTINGS.long_runs():
        logger.info(sentence)

DIFFERS = differences(json.loads(SETTINGS.model_dump_json()))  # from what the claims are about
OWN_CASES = [case for case in SETTINGS.cases if case not in PAPER_CASES]
OWN_SURVEYS = list(SETTINGS.surveys)
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


def datasets(folder, *names):
    return [f"<results>/{folder}/{name}.nc" for name in names]


def checks(*names):
    return datasets("checks", *names)


def runs_by(solver):
    """Return the datasets of all cases of the paper by a solver, which is most cases' own."""

    def run_by(case):
        own = SETTINGS.problem(case)["solver"] == SETTINGS.problem(case, solver)["solver"]
        return case if own else f"{case}.{solver}"

    return datasets("trajectories", *map(run_by, PAPER_CASES))


TRAJECTORIES = datasets("trajectories", *PAPER_CASES)
SWEEPS = datasets("sweeps", *PAPER_SWEEPS)
SECOND_SWEEPS = datasets("sweeps", "fig5_left.crank_nicolson", "fig6_left.crank_nicolson")


def one_of(names):
    return "|".join(names) or "(?!)"  # an empty pattern would match any name, this one matches none


pathvars:
    logs="<results>/logs",
    paper_case=f"{{case,{one_of(PAPER_CASES)}}}",
    own_case=f"{{case,{one_of(OWN_CASES)}}}",
    paper_sweep=f"{{sweep,{one_of(PAPER_SWEEPS)}}}",
    own_sweep=f"{{sweep,{one_of(OWN_SWEEPS)}}}",
    own_survey=f"{{survey,{one_of(OWN_SURVEYS)}}}",
    any_case=f"{{case,{one_of(SETTINGS.cases)}}}",
    any_sweep=f"{{sweep,{one_of(SETTINGS.sweeps)}}}",
    any_solver=f"{{solver,{one_of([*ALL_SOLVERS, 'auto', 'kahan_li'])}}}",
    size="{size,(long/)?}",  # a longer study lies in a folder of its own


ERRORS = Errors()
logger.addHandler(ERRORS)


def what_failed():
    """Return why jobs failed, as their own logs say or else Snakemake."""
    reasons = why_jobs_failed(ERRORS.text)
    return "\n".join(f"{why}\n  (more in {from_outside(path)})" for why, path in reasons)


def from_outside(path):
    """Return a path as it is for the user, who may have called Snakemake with --directory."""
    return os.path.join(workflow.overwrite_workdir or "", path)


def refuse_folders_that_are_read_only():
    """Stop before the first job if a file that the run makes would be in such a folder."""
    jobs = list(workflow.dag.needrun_jobs())
    parents = {Path(file).absolute().parent for job in jobs for file in (*job.output, *job.log)}
    there = {next(one for one in (path, *path.parents) if one.exists()) for path in parents}
    for folder in sorted(there):
        if not os.access(folder, os.W_OK):
            stop(f"{folder} is read-only: make it writable, or name another by --directory")


def refuse_what_slurm_never_starts():
    """Stop before the first job if Slurm would keep one waiting for ever, in silence."""
    if os.environ.get("SNAKEMAKE_SLURM_PARTITIONS") or workflow.executor_settings.partition_config:
        return  # the plugin chooses partitions
    requests = [
        (job.rule.name, job.resources.get("slurm_partition"), job.resources.get("runtime"))
        for job in workflow.dag.needrun_jobs()
    ]
    if refused := never_started(requests, partitions_of_slurm()):
        stop("\n".join(refused))


def environment(name):
    """Return a function that gives the file of a conda environment.

    Snakemake would take what is in braces in the path of the project for a wildcard.
    """
    path = f"{PROJECT}/workflow/envs/{name}.yaml".replace("{", "{{").replace("}", "}}")
    return lambda wildcards: path


# --- Names of files -------------------------------------------------------------------------------

FIGURE_KINDS = ["png", "pdf", "nc", "json"]


def files_of(stem):
    """Return all files of a figure: two pictures, what they show as a dataset, and in words."""
    return [f"{stem}.{kind}" for kind in FIGURE_KINDS]


def figure_files(stem):
    """Return the same as outputs: `snakemake --report` shows the picture."""
    picture, *others = files_of(stem)
    return [report(picture, category="Figures"), *others]


def kernels(*solvers):
    pairs = [["taylor", "dop853"] if solver == "auto" else [solver] for solver in solvers]
    return [f"<results>/kernels/{name}.txt" for pair in pairs for name in pair]


def kernels_of(problem, *solvers):
    """Return the kernels that a run of this problem waits for, by its own solver or by these.

    Those of other equations are compiled by the first job that needs them, and others wait for it.
    """
    return [] if "model" in problem else kernels(*solvers or [problem["solver"]["name"]])


def committed(**files):
    """Return files of the project that a job is given under these names, by content.

    They are parameters and no inputs: so a copy of the project depends on the same, wherever it is.
    A name has one path below the project's folder, or a list of them.
    """

    def with_digest(path):
        return [path, digest_of(PROJECT / path)]

    return {
        name: with_digest(one) if isinstance(one, str) else list(map(with_digest, one))
        for name, one in files.items()
    }


def references(*names):
    return [f"tests/baseline/reference/{name}.nc" for name in names]


def some_own_files(wildcards):
    """Return every figure and dataset of one's own cases and sweeps."""
    if not (OWN_CASES or OWN_SWEEPS or OWN_SURVEYS):
        stop(
            "the configuration has no case, sweep or survey of your own: give some by "
            "--configfile, as docs/own_cases.md shows"
        )
    made = {"trajectories": OWN_CASES, "sweeps": OWN_SWEEPS, "surveys": OWN_SURVEYS}
    places = [f"{kind}/{one}" for kind in made for one in made[kind]]
    of_models = [case for case in OWN_CASES if SETTINGS.cases[case].model not in MODELS]
    figures = [
        *(f"cases/{case}{part}" for case in OWN_CASES for part in ("", ".spacetime")),
        *(f"cases/{case}.breather" for case in of_models),
        *(place for place in places if not place.startswith("trajectories/")),
    ]
    return [
        *expand("<results>/{place}.nc", place=places),
        *expand("<results>/own/tables/{place}.csv", place=places),
        *expand("<results>/own/cases/{case}.checks.nc", case=OWN_CASES),
        *(file for figure in figures for file in files_of(f"<results>/own/{figure}")),
    ]


# --- Parts of many runs ----------------------------------------------------------------------------


def parts_of(whole):
    """Return a function of the wildcards that names the files of all parts of a dataset.

    They are none if all of its runs are made in one job.
    """

    def files(wildcards):
        name = whole.format(**dict(wildcards.items()))
        count = chunks_of(name)
        return [
            f"<results>/{name}.parts/{n}-of-{count}.nc" for n in range(count if count > 1 else 0)
        ]

    return files


def chunks_of(whole):
    """Return the number of parts of a dataset: of the command line, or of those that are there.

    A survey of one's own may ask for a number, and otherwise has as many parts as there are cores.
    """
    folder, _, name = whole.partition("/")
    own = SETTINGS.surveys[name] if folder == "surveys" else None
    there = sorted(Path(f"results/{whole}.parts").glob("*-of-*.nc"))
    cores = workflow.resource_settings.cores
    if asked_for := OPTIONS["chunks"] or (own and own.chunks):
        count = int(asked_for)
    elif there:
        count = int(there[0].stem.rpartition("-of-")[2])
    else:
        count = cores if own and isinstance(cores, int) else 1
    return min(count, math.prod(own.plan.shape)) if own else count


@cache
def given_to(whole):
    """Return what the job of a dataset is given, and the kernels that it waits for."""
    path = f"results/{whole}.nc"
    maker = next(one for one in workflow.rules if one.name != "part" and one.is_producer(path))
    wildcards = SimpleNamespace(**maker.get_wildcards(path))

    def of_job(value):
        if callable(value):
            return value(wildcards)
        return value.format(**vars(wildcards)) if isinstance(value, str) else value

    kernels, params = (dict(one.items()) for one in (maker.input, maker.params))
    given = {name: of_job(value) for name, value in params.items()}
    return {**given, **given.pop("given", {})}, of_job(kernels.get("kernels", []))


def cost_of_part(wildcards):
    """Return what a part of a dataset takes, by an estimate or, of a longer study, an hour."""
    folder, _, name = wildcards.whole.partition("/")
    if folder == "surveys":
        return SETTINGS.cost_of_survey(name, int(wildcards.parts))
    return LONG if folder == "long" else Cost(0.0, 0.0)
