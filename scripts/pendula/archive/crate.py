"""ro-crate-metadata.json: the archive as a Workflow RO-Crate 1.0, upon RO-Crate 1.1."""

from collections.abc import Iterable

from .about import About
from .crate_files import describe_files
from .people import agent, article

CONTEXT = "https://w3id.org/ro/crate/1.1/context"
PROFILES = ("https://w3id.org/ro/crate/1.1", "https://w3id.org/workflowhub/workflow-ro-crate/1.0")
WORKFLOW = "Snakefile"
LANGUAGE = "https://w3id.org/workflowhub/workflow-ro-crate#snakemake"


def describe(about: About, sizes: dict[str, int]) -> dict:
    """Return the description as JSON-LD; `sizes` are those of the packed files by name."""
    authors = _identified(agent(author) for author in about.authors)
    scientists = _identified(agent(author) for author in about.paper["authors"])
    paper = {**article(about.paper), "author": _links(scientists)}
    files = describe_files(sizes)
    workflow = {**_workflow(about), "author": _links(authors), "contentSize": str(sizes[WORKFLOW])}
    root = {
        **_root(about),
        "author": _links(authors),
        "publisher": _links(authors),
        "citation": _link(paper),
        "hasPart": _links([workflow, *files]),
    }
    people = {entity["@id"]: entity for entity in [*authors, *scientists]}.values()
    terms = [_license(about), _language(about), paper]
    graph = [_descriptor(), root, workflow, *files, *people, *terms]
    return {"@context": CONTEXT, "@graph": graph}


def _descriptor() -> dict:
    return {
        "@id": "ro-crate-metadata.json",
        "@type": "CreativeWork",
        "about": {"@id": "./"},
        "conformsTo": [{"@id": profile} for profile in PROFILES],
    }


def _root(about: About) -> dict:
    return {
        "@id": "./",
        "@type": "Dataset",
        "name": about.title,
        "description": f"{about.description}: code, environment, datasets and figures",
        "version": about.version,
        "datePublished": about.released,
        "license": {"@id": about.license_url},
        "mainEntity": {"@id": WORKFLOW},
    }


def _workflow(about: About) -> dict:
    return {
        "@id": WORKFLOW,
        "@type": ["File", "SoftwareSourceCode", "ComputationalWorkflow"],
        "name": about.title,
        "description": about.description,
        "version": about.version,
        "encodingFormat": "text/plain",
        "license": {"@id": about.license_url},
        "programmingLanguage": {"@id": LANGUAGE},
        "conformsTo": {"@id": "https://bioschemas.org/profiles/ComputationalWorkflow/1.0-RELEASE"},
    }


def _language(about: About) -> dict:
    names = {"name": "Snakemake", "alternateName": "snakemake", "version": about.pin("snakemake")}
    home = {"@id": "https://snakemake.github.io"}
    return {"@id": LANGUAGE, "@type": "ComputerLanguage", **names, "identifier": home, "url": home}


def _license(about: About) -> dict:
    text = f"{about.license}, see the file LICENSE"
    known = {"name": about.license, "description": text, "identifier": about.license_url}
    return {"@id": about.license_url, "@type": "CreativeWork", **known}


def _identified(entities: Iterable[dict]) -> list[dict]:
    """Give entities without a page of their own an identifier in this file."""
    return [{"@id": f"#{e['name'].replace(' ', '-')}", **e} for e in entities]


def _link(entity: dict) -> dict:
    return {"@id": entity["@id"]}


def _links(entities: Iterable[dict]) -> dict | list[dict]:
    """Link to each; one alone stands without brackets."""
    links = [_link(entity) for entity in entities]
    return links[0] if len(links) == 1 else links
