"""The facts about the project, and codemeta.json, which says them in the words of CodeMeta 3.0.

Each fact stands in one file only: CITATION.cff, pyproject.toml or environment.txt.
"""

import tomllib
from dataclasses import dataclass
from pathlib import Path

import yaml

from pendula import __version__

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

    def pin(self, package: str) -> str:
        """Return the version of a pinned package."""
        return dict(self.pins)[package]


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
        pins=tuple(tuple(pin.split("==")) for pin in pins),
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


def describe(about: About) -> dict:
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
