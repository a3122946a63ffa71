"""The description of an archive: ro-crate-metadata.json, as a Workflow RO-Crate 1.0.

Each fact about the project stands in one file only: CITATION.cff, LICENSE-DATA or environment.txt.

The library rocrate, which writes the crate, puts the time of the run wherever it has no date, and a
random identifier where it has none. So the root gets the date of the release, and every entity an
identifier: the same files give the same bytes.
"""

from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from urllib.parse import quote

import netCDF4
import yaml
from rocrate.model import ContextEntity
from rocrate.rocrate import ROCrate

from pendula import __version__
from pendula.datasets.netcdf import readable

from .contents import Content

WORKFLOW = "Snakefile"
FORMATS = {
    ".nc": "application/netcdf",
    ".png": "image/png",
    ".pdf": "application/pdf",
    ".html": "text/html",
    ".md": "text/markdown",
    ".json": "application/json",
}


def describe_archive(project: Path, members: Mapping[str, Content]) -> dict:
    """Return the description of an archive with these members, by name, as JSON-LD.

    It cites the paper that CITATION.cff of the `project` names first among its references, and
    describes each result.
    """
    citation = yaml.safe_load((project / "CITATION.cff").read_text("utf-8"))
    pins = (project / "environment.txt").read_text("utf-8").split()
    of_data = (project / "LICENSE-DATA").read_text("utf-8").split()[1]
    crate = ROCrate(version="1.1")
    facts = {
        "name": citation["title"],
        "version": __version__,
        "author": [_author(crate, author) for author in citation["authors"]],
        "license": _license(crate, citation["license"]),
    }
    of_root = {
        "description": f"{citation['title']}: code, environment, datasets and figures",
        "datePublished": str(citation["date-released"]),
        "citation": _paper(crate, citation["references"][0]),
    }
    for key, value in (facts | of_root).items():
        crate.root_dataset[key] = value
    (release,) = (pin.split("==")[1] for pin in pins if pin.startswith("snakemake=="))
    language = {"lang": "snakemake", "lang_version": release}
    crate.add_workflow(dest_path=WORKFLOW, main=True, properties=facts, **language)
    crate.add_file(dest_path="README.md", properties={"about": {"@id": "./"}})
    rights = {"license": _license(crate, of_data)}
    for name in sorted(name for name in members if name.startswith("results/")):
        crate.add_file(dest_path=name, properties=_about_result(name, members) | rights)
    return crate.metadata.generate()


def _about_result(name: str, members: Mapping[str, Content]) -> dict:
    """Return facts on a result: of a dataset its title, of a figure the dataset that it shows."""
    path, content = PurePosixPath(name), members[name]
    size = len(content) if isinstance(content, bytes) else content.stat().st_size
    facts = {
        "name": path.name,
        "encodingFormat": FORMATS.get(path.suffix, "text/plain"),
        "contentSize": str(size),
    }
    data = path.with_suffix(".nc").as_posix()
    if path.suffix == ".nc" and isinstance(content, Path):
        with readable(content), netCDF4.Dataset(content) as file:
            facts["description"] = file.title
    elif data in members:
        facts["isBasedOn"] = {"@id": quote(data)}
    return facts


def _license(crate: ROCrate, name: str) -> ContextEntity:
    return _entity(crate, f"https://spdx.org/licenses/{name}", "CreativeWork", name=name)


def _author(crate: ROCrate, author: dict) -> ContextEntity:
    """Return an author of CITATION.cff; one who has but one name is an organization."""
    kind = "Organization" if "name" in author else "Person"
    name = author.get("name") or f"{author['given-names']} {author['family-names']}"
    page = author.get("orcid") or author.get("website") or f"#{name.replace(' ', '-')}"
    return _entity(crate, page, kind, name=name)


def _paper(crate: ROCrate, paper: dict) -> ContextEntity:
    authors = [_author(crate, author) for author in paper["authors"]]
    page, year = f"https://doi.org/{paper['doi']}", str(paper["year"])
    words = {"name": paper["title"], "datePublished": year, "author": authors}
    return _entity(crate, page, "ScholarlyArticle", **words)


def _entity(crate: ROCrate, identifier: str, kind: str, **facts) -> ContextEntity:
    return crate.add(ContextEntity(crate, identifier, properties={"@type": kind, **facts}))
