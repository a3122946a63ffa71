"""codemeta.json: the software, in the words of CodeMeta 3.0."""

from .about import About
from .people import agent, article

CONTEXT = "https://w3id.org/codemeta/3.0"


def describe(about: About) -> dict:
    """Return the description as JSON-LD."""
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
    """Write keywords as CodeMeta does."""
    return {key.removeprefix("@"): value for key, value in entity.items()}


def _requirement(name: str, version: str) -> dict:
    where = {"type": "Organization", "name": "Python Package Index", "url": "https://pypi.org"}
    found = {"identifier": f"https://pypi.org/project/{name}/{version}/", "provider": where}
    return {"type": "SoftwareApplication", "name": name, "version": version, **found}
