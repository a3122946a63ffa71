"""What is installed is the library with all its files, and runs with what it declares alone.

`.ci/elsewhere installs` installs it in empty environments, which fetches packages.
"""

import ast
import json
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from latticode.kernels import sources
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[1]
LIBRARIES = [ROOT / "scripts/pendula", ROOT / "scripts/replication"]
WRITTEN = [
    tomllib.loads((home / "pyproject.toml").read_text())
    for home in (ROOT, *sorted(ROOT.glob("packages/*")))
]
HOMES = {settings["project"]["name"]: settings for settings in WRITTEN}
"""The pyproject.toml of each of our packages."""
DECLARED = HOMES["pendula"]["project"]["dependencies"]
PINS = [line for line in (ROOT / "environment.txt").read_text().split() if "==" in line]
OURS = {"pendula", "replication", "latticode"}
OPTIONAL = {"heyoka", "snakemake"}
"""What one command needs, which its page has the reader install, and what runs the workflow."""


def names(requirements) -> set[str]:
    return {canonicalize_name(Requirement(requirement).name) for requirement in requirements}


def imported_by(module: Path) -> set[str]:
    """Return the packages that a module imports, its own apart."""
    statements = list(sources._statements(sources._tree_of(module.read_text())))
    modules = [
        alias.name for node in statements if isinstance(node, ast.Import) for alias in node.names
    ]
    of_names = [node for node in statements if isinstance(node, ast.ImportFrom) and not node.level]
    return {name.split(".")[0] for name in (*modules, *(node.module for node in of_names))}


def test_the_library_declares_what_its_modules_import():
    modules = set().union(
        *(imported_by(path) for library in LIBRARIES for path in library.rglob("*.py"))
    )
    remaining = modules - set(sys.stdlib_module_names) - OURS - OPTIONAL
    homes = packages_distributions()
    shipped = HOMES["latticode"]["project"]["dependencies"]  # it is installed with the library
    assert names(homes[name][0] for name in remaining) | names(shipped) == names(DECLARED)
    assert set(shipped) < set(DECLARED)
    assert names(DECLARED) < names(PINS)


def test_uv_installs_the_pins_of_the_environment():
    group = HOMES["pendula"]["dependency-groups"]["dev"]
    assert [entry for entry in group if "@" not in entry] == PINS


@pytest.mark.parametrize("home", HOMES)
def test_no_installer_asks_an_index_for_a_package_of_the_project(home):
    """A stranger may have registered that name. With a path beside it, no index is asked."""
    project = HOMES[home]["project"]
    groups = HOMES[home].get("dependency-groups", {}), project.get("optional-dependencies", {})
    requirements = {
        *HOMES[home]["build-system"]["requires"],
        *project["dependencies"],
        *(entry for group in groups for each in group.values() for entry in each),
    }
    assert len(HOMES) == 3
    assert HOMES.keys().isdisjoint(
        names(entry for entry in requirements if not Requirement(entry).url)
    )


def test_binder_and_codespaces_install_the_environment_which_has_the_packages():
    binder = (ROOT / ".binder/requirements.txt").read_text()
    codespaces = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text())
    assert binder == "-r ../environment.txt\n"
    assert codespaces["postCreateCommand"] == "pip install -r environment.txt"
    assert "-e ." in (ROOT / "environment.txt").read_text().splitlines()
