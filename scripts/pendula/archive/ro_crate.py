"""ro-crate-metadata.json: the archive as a Workflow RO-Crate 1.0, written by the library rocrate.

The library puts the time of the run where it is told nothing, and a random identifier. So the root
gets the date of the release, and every entity an identifier: the same files give the same bytes.
"""

from collections.abc import Mapping
from fnmatch import fnmatchcase
from pathlib import Path, PurePosixPath
from urllib.parse import quote

import netCDF4
from rocrate.model import ContextEntity, File
from rocrate.rocrate import ROCrate

from .codemeta import About, agent, article
from .contents import Content

WORKFLOW = "Snakefile"
BIOSCHEMAS = "https://bioschemas.org/profiles/ComputationalWorkflow/1.0-RELEASE"

FORMATS = {
    ".nc": "application/netcdf",
    ".png": "image/png",
    ".pdf": "application/pdf",
    ".html": "text/html",
    ".md": "text/markdown",
    ".json": "application/json",
    ".yaml": "application/yaml",
    ".toml": "application/toml",
    ".cff": "application/yaml",
}
PLACES = {  # The first pattern that fits counts; a file that none fits belongs to its folder.
    "results/*.nc": "A dataset",
    "results/*.png": "A figure",
    "results/*.pdf": "A figure",
    "results/*.md": "A table",
    "results/code/*": "The record of the code that a job depends on, with checksums",
    "results/kernels/*": "A mark that a solver was compiled",
    "results/report.html": "The report: all figures, numbers and verdicts on one page",
    "results/claims.json": "The paper's claims, with a verdict on each",
    "results/*": "A result",
    "README.md": "What this is, how to run it, what comes out",
    "ARCHITECTURE.md": "How the parts fit together",
    "CHANGELOG.md": "What changed from version to version",
    "CITATION.cff": "How to cite this work, and the paper that it replicates",
    "LICENSE": "The license",
    "environment.txt": "The exact versions of all packages",
    "configuration.yaml": "The configuration that these results were made with",
    "codemeta.json": "The software in the words of CodeMeta",
}
FOLDERS = {
    "benchmarks/": "Measurements of speed against error",
    "config/": "The paper's cases and sweeps",
    "docs/": "Findings, cases of one's own, accuracy and speed, clusters and archives",
    "profiles/": "How Snakemake runs: here, and on a cluster",
    "scripts/": "The library, and one script a rule",
    "tests/": "The tests, and the accepted results",
    "workflow/": "The rules of the workflow, and its environments",
}


def describe(about: About, members: Mapping[str, Content]) -> dict:
    """Return the description of an archive with these members, by name, as JSON-LD.

    There is one entity for each result and each file of the top folder, and one for each folder.
    """
    crate = ROCrate(version="1.1")
    authors = _agents(crate, about.authors)
    license_ = _license(crate, about)
    _describe_root(crate, about, authors, license_)
    _add_workflow(crate, about, authors, license_, members[WORKFLOW])
    for name in sorted(members):
        if text := _place(name, members[name]):
            _add_file(crate, name, text, members)
    for folder, text in FOLDERS.items():
        if any(name.startswith(folder) for name in members):
            facts = {"name": folder, "description": text}
            crate.add_directory(dest_path=folder, properties=facts)
    return crate.metadata.generate()


def _describe_root(crate: ROCrate, about: About, authors: list, license_: ContextEntity) -> None:
    facts = {
        "name": about.title,
        "description": f"{about.description}: code, environment, datasets and figures",
        "version": about.version,
        "datePublished": about.released,
        "license": license_,
        "author": authors,
        "publisher": authors,
        "citation": _paper(crate, about.paper),
    }
    for key, value in facts.items():
        crate.root_dataset[key] = value


def _add_workflow(
    crate: ROCrate, about: About, authors: list, license_: ContextEntity, content: Content
) -> None:
    facts = {
        "name": about.title,
        "description": about.description,
        "version": about.version,
        "encodingFormat": "text/plain",
        "contentSize": str(_size(content)),
        "license": license_,
        "author": authors,
        "conformsTo": {"@id": BIOSCHEMAS},
    }
    language = {"lang": "snakemake", "lang_version": about.pin("snakemake")}
    crate.add_workflow(dest_path=WORKFLOW, main=True, properties=facts, **language)


def _add_file(crate: ROCrate, name: str, text: str, members: Mapping[str, Content]) -> File:
    path = PurePosixPath(name)
    facts = {
        "name": path.name,
        "description": text,
        "encodingFormat": FORMATS.get(path.suffix, "text/plain"),
        "contentSize": str(_size(members[name])),
    }
    if name == "README.md":
        facts["about"] = {"@id": "./"}
    data = path.with_suffix(".nc").as_posix()
    if path.suffix in (".png", ".pdf") and data in members:
        facts["isBasedOn"] = {"@id": quote(data)}
    return crate.add_file(dest_path=name, properties=facts)


def _place(name: str, content: Content) -> str | None:
    """Return what a file is: a dataset says it in its title, any other file by its place."""
    if fnmatchcase(name, "results/*.nc") and isinstance(content, Path):
        with netCDF4.Dataset(content) as data:
            if title := getattr(data, "title", ""):
                return title
    return next((text for pattern, text in PLACES.items() if fnmatchcase(name, pattern)), None)


def _size(content: Content) -> int:
    return len(content) if isinstance(content, bytes) else content.stat().st_size


def _agents(crate: ROCrate, authors: tuple[dict, ...] | list[dict]) -> list[ContextEntity]:
    """Add authors; those without a page of their own get an identifier inside the crate."""
    described = [agent(author) for author in authors]
    named = [{"@id": f"#{each['name'].replace(' ', '-')}", **each} for each in described]
    return [_add_entity(crate, each) for each in named]


def _paper(crate: ROCrate, paper: dict) -> ContextEntity:
    return _add_entity(crate, {**article(paper), "author": _agents(crate, paper["authors"])})


def _license(crate: ROCrate, about: About) -> ContextEntity:
    url, text = about.license_url, f"{about.license}, see the file LICENSE"
    known = {"name": about.license, "description": text, "identifier": url}
    return _add_entity(crate, {"@id": url, "@type": "CreativeWork", **known})


def _add_entity(crate: ROCrate, described: dict) -> ContextEntity:
    return crate.add(ContextEntity(crate, described["@id"], properties=described))
