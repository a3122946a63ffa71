"""Names of the inputs and outputs of rules."""

from collections.abc import Callable, Iterable, Mapping
from math import prod
from typing import Any

from latticode.configuration.files import ConfigurationError

from pendula.configuration.paper import Differences, concerning
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS, PaperConfiguration
from pendula.contract.arguments import name_of
from pendula.problem import MODELS

FIGURE_KINDS = ("png", "pdf", "nc", "json")
"""Endings of the files of a figure: two pictures, the data that they show, and a description."""

PAPER_FIGURES = ("fig1", "fig2", "fig3", "fig4", "fig5", "fig6")
"""The rendered figures of the paper."""


def datasets(folder: str, *names: str) -> list[str]:
    """Return the paths of datasets in a folder of the results."""
    return [f"<results>/{folder}/{name}.nc" for name in names]


def checks(*names: str) -> list[str]:
    """Return the paths of datasets in results/checks."""
    return datasets("checks", *names)


def figure_files(*stems: str) -> list[str]:
    """Return all files of figures, given by their paths without ending."""
    return [f"{stem}.{kind}" for stem in stems for kind in FIGURE_KINDS]


def kernels(*solvers: str) -> list[str]:
    """Return the records of compiled solvers that a job waits for; "auto" means two solvers."""
    pairs = [["taylor", "dop853"] if solver == "auto" else [solver] for solver in solvers]
    return [f"<results>/kernels/{name}.txt" for pair in pairs for name in pair]


def kernels_for(problem: Mapping, *solvers: str) -> list[str]:
    """Return the records of compiled solvers that a problem waits for: its own, or `solvers`.

    Solvers of equations other than (4) are compiled by the first job that needs them.
    """
    return [] if "model" in problem else kernels(*solvers or [problem["solver"]["name"]])


def any_of(names: Iterable[str]) -> str:
    """Return a regular expression that matches only these names; without names it never matches."""
    return "|".join(names) or "(?!)"


CHUNK = r"(\.parts/\d+-of-\d+)?"
"""The ending of a chunk's name after the name of its study."""


def chunks_of(gather: Any, pattern: str, process: str = "runs") -> Callable:
    """Return an input function for the chunks of a study's runs. One job for all runs has none.

    `pattern` is the path of the dataset below results/ without its ending, `process` the name of a
    `scattergather` process; both may have wildcards. `gather` is Snakemake's object.
    """

    def files(wildcards: Any) -> list[str]:
        values = dict(wildcards.items())
        if values["chunk"]:  # this job makes a chunk
            return []
        stem = f"<results>/{pattern.format(**values)}.parts"
        chunks = getattr(gather, process.format(**values))(f"{stem}/{{scatteritem}}.nc")
        return chunks if len(chunks) > 1 else []

    return files


def chunks_in(chunk: str) -> int:
    """Return the number of chunks of a study from the wildcard of one, such as ".parts/2-of-8"."""
    return int(chunk.rpartition("-of-")[2] or 1)


CHUNKS_OF_A_SURVEY = 8
"""Default number of chunks of a survey, enough jobs for the cores of most machines."""


def chunks_of_surveys(surveys: Mapping[str, Any], overwritten: Mapping[str, int]) -> dict[str, int]:
    """Return the number of chunks of each survey, by the name of its scattergather process.

    It is its `chunks`, or else N in `--set-scatter runs=N`, but at most the number of runs.
    """
    default = overwritten.get("runs", CHUNKS_OF_A_SURVEY)
    return {
        process_of_survey(name): min(prod(survey.plan.shape), survey.chunks or default)
        for name, survey in surveys.items()
    }


def process_of_survey(name: str) -> str:
    """Return the name of the scattergather process of a survey; `name` may be a wildcard."""
    return f"survey_{name}"


def runs_by(settings: PaperConfiguration, solver: str) -> list[str]:
    """Return the paths of the trajectories of all the paper's cases by a solver."""

    def run_by(case: str) -> str:
        is_own_solver = settings.problem(case)["solver"] == settings.problem(case, solver)["solver"]
        return case if is_own_solver else f"{case}.{solver}"

    return datasets("trajectories", *map(run_by, PAPER_CASES))


def own_files(settings: PaperConfiguration) -> list[str]:
    """Return all files of the user's cases, sweeps and surveys, or raise ConfigurationError."""
    cases = [case for case in settings.cases if case not in PAPER_CASES]
    sweeps = [sweep for sweep in settings.sweeps if sweep not in PAPER_SWEEPS]
    names_by_folder = {"trajectories": cases, "sweeps": sweeps, "surveys": settings.surveys}
    motions = [f"spectra/{name}" for name in settings.spectra]
    motions += [f"sections/{name}" for name in settings.sections]
    if not any([*names_by_folder.values(), motions]):
        raise ConfigurationError(
            "the configuration has no case, sweep or survey of your own: add one with "
            "--configfile (see docs/own_cases.md)"
        )
    places = [f"{folder}/{name}" for folder, names in names_by_folder.items() for name in names]
    of_models = [case for case in cases if settings.cases[case].model not in MODELS]
    figures = [f"cases/{case}{ending}" for case in cases for ending in ("", ".spacetime")]
    figures += [f"cases/{case}.breather" for case in of_models]
    figures += [place for place in places if not place.startswith("trajectories/")]
    return [
        *(f"<results>/{place}.nc" for place in [*places, *motions]),
        *(f"<results>/own/tables/{place}.csv" for place in places),
        *(f"<results>/own/cases/{case}.checks.nc" for case in cases),
        *figure_files(*(f"<results>/own/{figure}" for figure in figures)),
    ]


def differs_of(differs: Differences, wildcards: Any, input: Iterable[str]) -> list[str]:
    """Return the differences from the paper's configuration that affect a figure, as sentences.

    If trajectories or sweeps are among the inputs, a dataset of many cases counts only with these.
    """
    names = [name_of(path) for path in input if path.endswith(".nc")]
    names = [name for name in names if not name.startswith(("long/", "own/"))]
    split_names = [name.split("/", 1) for name in names]
    cases_and_sweeps = [
        name for folder, name in split_names if folder in ("trajectories", "sweeps")
    ]
    return list(concerning(differs, names, cases_and_sweeps).values())
