"""What is known of the project, from the files that say it: each fact stands in one of them."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

import yaml

from pendula import __version__


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
    """Read CITATION.cff, pyproject.toml and environment.txt."""
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
