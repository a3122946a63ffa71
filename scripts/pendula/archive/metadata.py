"""What an archive says of itself: codemeta.json, and ro-crate-metadata.json.

The first describes the software in the words of CodeMeta 3.0, the second the archive as a Workflow
RO-Crate 1.0. Each fact about the project stands in one file only: CITATION.cff, pyproject.toml or
environment.txt.

The library rocrate, which writes the crate, puts the time of the run wherever it has no date, and a
random identifier where it has none. So the root gets the date of the release, and every entity an
identifier: the same files give the same bytes.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path, PurePosixPath
from urllib.parse import quote

import netCDF4
import yaml
from rocrate.model import ContextEntity
from rocrate.rocrate import ROCrate

from pendula import __version__
from pendula.datasets.netcdf import readable

from .contents import Content

CONTEXT = "https://w3id.org/codemeta/3.0"


@dataclass(frozen=True)
class About:
    """Facts for citation and for catalogues; authors and the paper as in CITATION.cff."""

    name: str
    version: str
    title: str
    description: str
    released: str
    license: str
    authors: tuple[dict, ...]
    paper: dict
    python: str
    pins: tuple[tuple[str, str], ...]

    @property
    def license_url(self) -> str:
        """Return the page of the license in the list of SPDX."""
        return f"https://spdx.org/licenses/{self.license}"


def read_about(project: Path) -> About:
    """Read CITATION.cff, pyproject.toml and environment.txt in the project's folder."""
    citation = yaml.safe_load((project / "CITATION.cff").read_text("utf-8"))
    python = tomllib.loads((project / "pyproject.toml").read_text("utf-8"))["project"]
    pins = (project / "environment.txt").read_text("utf-8").split()
    return About(
        name=python["name"],
        version=__version__,
        title=citation["title"],
        description=python["description"],
        released=str(citation["date-released"]),
        license=citation["license"],
        authors=tuple(citation["authors"]),
        paper=citation["preferred-citation"],
        python=python["requires-python"],
        pins=tuple(tuple(pin.split("==")) for pin in pins if "==" in pin),
    )


def agent(author: dict) -> dict:
    """Return an author of CITATION.cff in the words of schema.org, with "@id" where one is known.

    An author who has but one name is an organization.
    """
    known = author.get("orcid") or author.get("website")
    identity = {"@id": known} if known else {}
    if "name" in author:
        return {"@type": "Organization", "name": author["name"], **identity}
    given, family = author["given-names"], author["family-names"]
    names = {"name": f"{given} {family}", "givenName": given, "familyName": family}
    return {"@type": "Person", **names, **identity}


def article(paper: dict) -> dict:
    """Return a paper of CITATION.cff in the words of schema.org, without its authors."""
    found = [entry["value"] for entry in paper.get("identifiers", ())]
    return {
        "@id": f"https://doi.org/{paper['doi']}",
        "@type": "ScholarlyArticle",
        "name": paper["title"],
        "datePublished": str(paper["year"]),
        "identifier": [f"https://doi.org/{paper['doi']}", *found],
        "isPartOf": f"{paper['journal']} {paper['volume']}, {paper['start']}",
    }


def describe_software(about: About) -> dict:
    """Return codemeta.json as JSON-LD."""
    paper = article(about.paper)
    return {
        "@context": CONTEXT,
        "type": "SoftwareSourceCode",
        "name": about.name,
        "description": about.description,
        "version": about.version,
        "datePublished": about.released,
        "license": about.license_url,
        "author": [_plain(agent(author)) for author in about.authors],
        "programmingLanguage": "Python",
        "runtimePlatform": f"Python {about.python}",
        "softwareRequirements": [_requirement(*pin) for pin in about.pins],
        "readme": "README.md",
        "releaseNotes": "CHANGELOG.md",
        "referencePublication": {
            "id": paper["@id"],
            "type": f"schema:{paper['@type']}",  # not among the words that CodeMeta defines
            "name": paper["name"],
            "datePublished": paper["datePublished"],
            "author": [_plain(agent(author)) for author in about.paper["authors"]],
        },
    }


def _plain(entity: dict) -> dict:
    """Return the entity with its keywords written as CodeMeta writes them, without "@"."""
    return {key.removeprefix("@"): value for key, value in entity.items()}


def _requirement(name: str, version: str) -> dict:
    where = {"type": "Organization", "name": "Python Package Index", "url": "https://pypi.org"}
    found = {"identifier": f"https://pypi.org/project/{name}/{version}/", "provider": where}
    return {"type": "SoftwareApplication", "name": name, "version": version, **found}


# --- The crate ------------------------------------------------------------------------------------

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
    "results/figures/*.json": "What a figure shows, in words and numbers",
    "results/own/*.json": "What a figure shows, in words and numbers",
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
    "docs/": "A page for each task, what was found, accuracy and speed, datasets, baseline",
    "profiles/": "How Snakemake runs: here, and on a cluster",
    "scripts/": "The library, and one script for each rule",
    "tests/": "The tests, and the accepted results",
    "workflow/": "The rules of the workflow, and its environments",
}


def describe_archive(about: About, members: Mapping[str, Content]) -> dict:
    """Return the description of an archive with these members, by name, as JSON-LD.

    There is one entity for each result and each file of the top folder, and one for each folder.
    """
    crate = ROCrate(version="1.1")
    _describe_whole(crate, about, members)
    for name in sorted(members):
        if text := _place(name, members[name]):
            _add_file(crate, name, text, members)
    for folder, text in FOLDERS.items():
        if any(name.startswith(folder) for name in members):
            facts = {"name": folder, "description": text}
            crate.add_directory(dest_path=folder, properties=facts)
    return crate.metadata.generate()


def _describe_whole(crate: ROCrate, about: About, members: Mapping[str, Content]) -> None:
    """Describe the root of the crate, and the workflow, which have most facts in common."""
    authors = _agents(crate, about.authors)
    facts = {
        "name": about.title,
        "version": about.version,
        "license": _license(crate, about),
        "author": authors,
    }
    of_root = {
        "description": f"{about.description}: code, environment, datasets and figures",
        "datePublished": about.released,
        "publisher": authors,
        "citation": _paper(crate, about.paper),
    }
    for key, value in (facts | of_root).items():
        crate.root_dataset[key] = value
    of_workflow = {
        "description": about.description,
        "encodingFormat": "text/plain",
        "contentSize": str(_size(members[WORKFLOW])),
        "conformsTo": {"@id": BIOSCHEMAS},
    }
    language = {"lang": "snakemake", "lang_version": dict(about.pins)["snakemake"]}
    crate.add_workflow(dest_path=WORKFLOW, main=True, properties=facts | of_workflow, **language)


def _add_file(crate: ROCrate, name: str, text: str, members: Mapping[str, Content]) -> None:
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
    if path.suffix in (".png", ".pdf", ".json") and data in members:
        facts["isBasedOn"] = {"@id": quote(data)}
    crate.add_file(dest_path=name, properties=facts)


def _place(name: str, content: Content) -> str | None:
    """Return what a file is: a dataset says it in its title, any other file by its place."""
    if fnmatchcase(name, "results/*.nc") and isinstance(content, Path):
        with readable(content), netCDF4.Dataset(content) as data:
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
