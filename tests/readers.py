"""Who reads what a run makes: claims, figures, datasets, variables and tables without a reader.

A reader is a sentence, a number or a figure of the article; a figure or a number of a page of
documents; a row of the ledger on a sentence of the paper, or one that the article uses; or another
dataset or figure that has a reader. The comparison of two runs reads trajectories and sweeps: were
it to count for all files, nothing would be without a reader.

Each dataset names the function that made it and the datasets that this has read; a claim names
those that it needs. A variable is read if its name stands in such a function or in what this calls,
or if a page of documents shows it to users; datasets of one form are read together.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import netCDF4
from code_words import Words, words_of_function, words_of_text
from helpers import ROOT
from latticode.datasets.stated import COMPUTED_BY, COMPUTED_FROM
from pendula.ledger.claim import Claim, Origin
from pendula.ledger.verdicts import all_claims

COMPARED, FIGURES, WRONG = ("trajectories/", "sweeps/"), "figures/", "/wrong/"
ARTICLE = [ROOT / f"scripts/pendula/article/{name}" for name in ("article.md.j2", "values.py")]
PAGES = [path for like in ("*.py", "source/*", "*.md") for path in ROOT.glob(f"docs/{like}")]
PAGES = [*(path for path in PAGES if path.stem != "article"), ROOT / "codecheck.yml"]


class Made(NamedTuple):
    """A dataset of a run: its variables, the function that made it, and what this has read."""

    variables: tuple[str, ...]
    function: str
    sources: tuple[str, ...]


class Run(NamedTuple):
    """What a run has made, and the claims and texts that may read it."""

    datasets: dict[str, Made]
    tables: list[str]
    claims: tuple[Claim, ...]
    article: str
    pages: str


def run_of(results: Path) -> Run:
    """Return what lies in a folder of results, with the article and the documents."""
    datasets = {}
    for path in sorted(results.rglob("*.nc")):
        with netCDF4.Dataset(path) as data:
            about = {key: data.getncattr(key) for key in data.ncattrs()}
            variables = tuple(name for name in data.variables if name not in data.dimensions)
        sources = tuple(filter(None, about.get(COMPUTED_FROM, "").split(", ")))
        name = path.relative_to(results).with_suffix("").as_posix()
        datasets[name] = Made(variables, about.get(COMPUTED_BY, ""), sources)
    tables = sorted(path.name for path in results.glob("tables/*"))
    article, pages = ("\n".join(map(Path.read_text, files)) for files in (ARTICLE, PAGES))
    return Run(datasets, tables, all_claims(), article, pages)


def unread(run: Run) -> Iterator[str]:
    """Yield in words each claim, figure, dataset, variable and table that nobody reads."""
    used = [one for one in run.claims if one.origin == Origin.PAPER or is_in(run.article, one.name)]
    yield from (f"claim {claim.name}" for claim in run.claims if claim not in used)
    readers = _readers(run, used)
    quoted = words_of_text(run.article)
    documented = set(re.findall(r"`(\w+)(?:\([\w, ]*\))?`", run.pages))
    for name, made in run.datasets.items():
        if not (readers[name] or name.startswith(COMPARED)):
            yield f"{'figure' if name.startswith(FIGURES) else 'dataset'} {name}"
        elif not name.startswith((FIGURES, *COMPARED)) and WRONG not in name:
            alike = [one for one, other in run.datasets.items() if _is_alike(made, other)]
            words = Words.union(word for one in alike for word in readers[one])
            if name.partition("/")[0] in quoted.names:  # the article reads its longer version
                words = Words.union([words, quoted])
            yield from (
                f"variable {name}:{one}"
                for one in made.variables
                if one not in documented and one not in words
            )
    yield from (f"table {name}" for name in run.tables if not is_in(run.pages, name))


def _is_alike(one: Made, other: Made) -> bool:
    """Return whether two datasets are of one form: the same function, and no other variables."""
    few, many = sorted((set(one.variables), set(other.variables)), key=len)
    return one.function == other.function and few <= many


def _readers(run: Run, claims: list[Claim]) -> dict[str, list[Words]]:
    """Return by dataset the words of each of its readers that are read themselves."""
    readers: dict[str, list[Words]] = {name: [] for name in run.datasets}
    for text, shows in ((run.article, 'figure("{}"'), (run.pages, "`{}`")):
        for name in run.datasets:
            if (
                shows.format(name.removeprefix(FIGURES)) in text
                or name in words_of_text(text).names
            ):
                readers[name].append(words_of_text(text))
    for claim in claims:
        words = words_of_function(claim.decide.__module__, claim.decide.__name__)
        fed = [name for control in claim.controls for name in control.names]
        for name in {*claim.needs, *fed} & readers.keys():
            readers[name].append(words)
    waiting = [name for name, found in readers.items() if found or name.startswith(COMPARED)]
    done: set[str] = set()
    while waiting:
        if (name := waiting.pop()) not in done:
            done.add(name)
            module, _, function = run.datasets[name].function.rpartition(".")
            gather = function.replace("draw", "gather", 1)
            for source in run.datasets[name].sources:
                if source in readers:
                    readers[source].append(words_of_function(module, function, gather))
                    waiting.append(source)
    return readers


def is_in(text: str, name: str) -> bool:
    """Return whether a text has this name, and not as a part of another."""
    return re.search(rf"(?<![\w.]){re.escape(name)}(?![\w])", text) is not None
