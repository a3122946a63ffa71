"""Nothing that a run makes is without a reader, and what is planted without one is found.

A reader is the article; a page of documents; a row of the ledger on a sentence of the paper, or one
that the article uses; or another dataset or figure that has a reader. The comparison of two runs
reads trajectories and sweeps: were it to count for all files, nothing would be without a reader.

Each dataset names the function that made it and the datasets that this has read; a claim names
those that it needs. A variable is read if its name stands in the text of a reader or of a module
that this imports, its maker apart. Datasets of one form are read together.
"""

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

import netCDF4
import pytest
from helpers import ROOT
from latticode.datasets.stated import COMPUTED_BY, COMPUTED_FROM
from latticode.kernels.sources import files_of_module, modules_of
from pendula.jobs.decide import all_claims
from replication.article.quoted import is_quoted
from replication.ledger.claim import Claim, Origin

COMPARED, FIGURES = ("trajectories/", "sweeps/"), "figures/"
ARTICLE = [
    ROOT / "scripts/pendula/article/article.md.j2",
    ROOT / "scripts/pendula/article/values.py",
    ROOT / "scripts/replication/article/numbers.py",
]
PAGES = [path for pattern in ("*.py", "source/*", "*.md") for path in ROOT.glob(f"docs/{pattern}")]
PAGES = [*(path for path in PAGES if path.stem != "article"), ROOT / "codecheck.yml"]


class Computed(NamedTuple):
    """A dataset of a run: its variables, the function that made it, and what this has read."""

    variables: tuple[str, ...]
    function: str
    sources: tuple[str, ...]

    @property
    def module(self) -> str:
        return self.function.rpartition(".")[0]


class Run(NamedTuple):
    """What a run has made, and the claims and texts that may read it."""

    datasets: dict[str, Computed]
    tables: list[str]
    claims: tuple[Claim, ...]
    article: str
    pages: str


def run_of(results: Path) -> Run:
    datasets = {}
    paths = {
        path.relative_to(results).with_suffix("").as_posix(): path
        for path in sorted(results.rglob("*.nc"))
    }
    for name, path in paths.items():
        if is_quoted(name):  # a copy of a committed file, which the article reads
            continue
        with netCDF4.Dataset(path) as data:
            attributes = {key: data.getncattr(key) for key in data.ncattrs()}
            variables = tuple(name for name in data.variables if name not in data.dimensions)
        sources = tuple(filter(None, attributes.get(COMPUTED_FROM, "").split(", ")))
        datasets[name] = Computed(variables, attributes.get(COMPUTED_BY, ""), sources)
    tables = sorted(path.name for path in results.glob("tables/*"))
    article, pages = ("\n".join(map(Path.read_text, files)) for files in (ARTICLE, PAGES))
    return Run(datasets, tables, all_claims(), article, pages)


@cache
def words_in(text: str) -> set[str]:
    return set(re.findall(r"\w+", text))


@cache
def words_behind(module: str, maker: str) -> set[str]:
    """Return the words of a module and of all that it imports, but for a maker that is another."""
    of_maker = {} if module == maker or not maker else set(files_of_module(maker)[-1:])
    files = [file for file in modules_of(*files_of_module(module)) if file not in of_maker]
    return set().union(*(words_in(file.read_text()) for file in files))


def is_read(name: str, words: set[str]) -> bool:
    """Return whether a name is among the words, or was made of one of them, as f"{norm}_low" is.

    Of `l2_low` the code then has the end `_low`, or the beginning `l2_`.
    """
    cuts = [place for place, letter in enumerate(name) if letter == "_"]
    beginnings, ends = {name[: at + 1] for at in cuts}, {name[at:] for at in cuts}
    return not words.isdisjoint({name} | beginnings | ends)


def is_in(text: str, name: str) -> bool:
    """Return whether a text has this name, and not as a part of another."""
    return re.search(rf"(?<![\w.]){re.escape(name)}(?![\w])", text) is not None


def readers_of(run: Run, claims: list[Claim]) -> dict[str, list[set[str]]]:
    """Return by dataset the words of each of its readers that are read themselves."""
    readers: dict[str, list[set[str]]] = {name: [] for name in run.datasets}
    for text, shows in ((run.article, 'figure("{}"'), (run.pages, "`{}`")):
        for name in readers:
            mention = shows.format(name.removeprefix(FIGURES))
            if mention in text or f'"{name}"' in text or f'"{name}.' in text:
                readers[name].append(words_in(text))
    for claim in claims:
        fed = [name for control in claim.controls for name in control.names]
        for name in {*claim.needs, *fed} & readers.keys():
            maker = run.datasets[name].module
            readers[name].append(words_behind(claim.decide.__module__, maker))
    waiting = [name for name, texts in readers.items() if texts or name.startswith(COMPARED)]
    done: set[str] = set()
    while waiting:
        if (name := waiting.pop()) not in done:
            done.add(name)
            for source in readers.keys() & set(run.datasets[name].sources):
                words = words_behind(run.datasets[name].module, run.datasets[source].module)
                readers[source].append(words)
                waiting.append(source)
    return readers


def unread(run: Run) -> list[str]:
    """Return kind and name of each claim, figure, dataset, variable and table without a reader."""
    used = [
        claim
        for claim in run.claims
        if claim.origin == Origin.PAPER or is_in(run.article, claim.name)
    ]
    unread_names = [f"claim {claim.name}" for claim in run.claims if claim not in used]
    readers, texts = readers_of(run, used), words_in(run.article) | words_in(run.pages)
    for name, dataset in run.datasets.items():
        if not (readers[name] or name.startswith(COMPARED)):
            unread_names.append(f"{'figure' if name.startswith(FIGURES) else 'dataset'} {name}")
        elif not name.startswith((FIGURES, *COMPARED)):
            of_same_function = [
                name_of_other
                for name_of_other, candidate in run.datasets.items()
                if candidate.function == dataset.function
            ]
            words = texts.union(
                *(words for name_of_other in of_same_function for words in readers[name_of_other])
            )
            unread_names += [
                f"variable {name}:{variable}"
                for variable in dataset.variables
                if not is_read(variable, words)
            ]
    return unread_names + [f"table {name}" for name in run.tables if not is_in(run.pages, name)]


@pytest.fixture(scope="module")
def run(full_run) -> Run:
    return run_of(full_run / "results")


def test_all_that_a_run_makes_has_a_reader(run):
    remedy = "show it in the article or a page of docs/, decide a claim by it, or make it no more"
    assert unread(run) == [], remedy


CLAIM = Claim("planted_claim", "Beyond", "It is mine.", (), lambda: None, (), origin=Origin.OWN)
PLANTED = Computed(("planted",), "", ())


def planted_in_lyapunov(run: Run) -> dict[str, Computed]:
    dataset = run.datasets["checks/lyapunov"]
    return run.datasets | {"checks/lyapunov": dataset._replace(variables=("planted",))}


@pytest.mark.parametrize(
    ("plant", "entries"),
    [
        (lambda run: {"claims": (*run.claims, CLAIM)}, ["claim planted_claim"]),
        (lambda run: {"tables": [*run.tables, "mine.md"]}, ["table mine.md"]),
        (
            lambda run: {"datasets": run.datasets | {"checks/mine": PLANTED}},
            ["dataset checks/mine"],
        ),
        (
            lambda run: {"datasets": run.datasets | {"figures/mine": PLANTED}},
            ["figure figures/mine"],
        ),
        (lambda run: {"datasets": planted_in_lyapunov(run)}, ["variable checks/lyapunov:planted"]),
    ],
)
def test_what_nobody_reads_is_found(run, plant, entries):
    before = unread(run)  # which the test above reports
    assert [entry for entry in unread(run._replace(**plant(run))) if entry not in before] == entries


def test_what_only_an_unread_figure_reads_has_no_reader(run):
    """The article has shown it, and its dataset, and all that this was computed from, with it."""
    unread_names = set(unread(run._replace(article="", pages="", claims=())))
    assert {
        "figure figures/growth_law",
        "dataset unbounded/fronts",
        "dataset checks/trust",
    } <= unread_names
    assert not any(entry.startswith("dataset trajectories/") for entry in unread_names)
