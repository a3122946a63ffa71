"""What is installed is the library with all its files, and runs with what it declares alone.

`.ci/elsewhere commands` installs it in an empty environment, which fetches packages.
"""

import ast
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

from latticode.kernels import sources
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[1]
LIBRARY = ROOT / "scripts/pendula"
DECLARED = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
OPTIONAL = {"heyoka"}
"""What one command needs, which its page has the reader install."""


def names(requirements) -> set[str]:
    return {canonicalize_name(Requirement(one).name) for one in requirements}


def imported_by(module: Path) -> set[str]:
    """Return the packages that a module imports, its own apart."""
    statements = list(sources._statements(sources._tree_of(module.read_text())))
    plain = [one.name for node in statements if isinstance(node, ast.Import) for one in node.names]
    of_names = [node for node in statements if isinstance(node, ast.ImportFrom) and not node.level]
    return {name.split(".")[0] for name in (*plain, *(node.module for node in of_names))}


def test_the_library_declares_what_its_modules_import():
    found = set().union(*map(imported_by, LIBRARY.rglob("*.py")))
    others = found - set(sys.stdlib_module_names) - {"pendula", "latticode"} - OPTIONAL
    homes = packages_distributions()
    assert names(homes[name][0] for name in others) | {"latticode"} == names(DECLARED)
    pins = (ROOT / "environment.txt").read_text().split()
    assert names(DECLARED) - {"latticode"} < names(pin for pin in pins if "==" in pin)
