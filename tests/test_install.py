"""What is installed is the library with all its files, and runs with what it declares alone.

The installs themselves fetch packages: `.ci/elsewhere commands` runs them.
"""

import ast
import os
import shutil
import subprocess
import sys
import sysconfig
import tomllib
import venv
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from helpers import package, skip
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from pendula import sources

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/notebook.md"
LIBRARY = ROOT / "scripts/pendula"
DECLARED = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
OPTIONAL = {"heyoka"}
"""What one command needs, which its page has the reader install."""

RUN_THE_PAGE = """
import doctest, pendula, sys
text = open(sys.argv[1], encoding="utf-8").read().replace("```", "")  # they would be output
page = doctest.DocTestParser().get_doctest(text, {}, "page", None, 0)
found = doctest.DocTestRunner().run(page)
print(pendula.__file__)
sys.exit(found.failed > 0 or found.attempted == 0)
"""


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, **options
    )


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
    others = found - set(sys.stdlib_module_names) - {"pendula"} - OPTIONAL
    homes = packages_distributions()
    assert names(homes[name][0] for name in others) == names(DECLARED)
    pins = (ROOT / "environment.txt").read_text().split()
    assert names(DECLARED) < names(pin for pin in pins if "==" in pin)


def files_in(folder: Path) -> set[Path]:
    return {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """Return a copy of what the package is built from: building leaves files beside it."""
    folder = tmp_path_factory.mktemp("project")
    shutil.copy(ROOT / "pyproject.toml", folder)
    mine = shutil.ignore_patterns("__pycache__", "*.egg-info")
    shutil.copytree(ROOT / "scripts", folder / "scripts", ignore=mine)
    return folder


def test_the_package_has_all_files_of_the_library(project, tmp_path):
    package("setuptools", "setuptools")
    command = ("-c", "from setuptools import setup; setup()", "-q", "build_py", "--build-lib")
    built = run(sys.executable, *command, tmp_path / "built", cwd=project)
    assert built.returncode == 0, built.stderr
    assert files_in(tmp_path / "built/pendula") == files_in(project / "scripts/pendula")


@pytest.fixture
def new(tmp_path):
    """Return a function: the interpreter and the packages' folder of a new, empty environment."""
    if not os.environ.get("PENDULA_AS_PRINTED"):
        skip("it fetches what builds the package", "run .ci/elsewhere commands")
    venv.create(tmp_path / "new")  # the pip of this environment can install into others
    home = "Scripts" if sys.platform == "win32" else "bin"
    paths = {"base": str(tmp_path / "new"), "platbase": str(tmp_path / "new")}
    return tmp_path / "new" / home / "python", Path(sysconfig.get_path("purelib", vars=paths))


def pip(*words):
    installed = run(sys.executable, "-m", "pip", *words)
    if "No matching distribution found for setuptools" in installed.stderr:
        skip("setuptools, which builds the package, cannot be fetched", "run it with a network")
    assert installed.returncode == 0, installed.stdout + installed.stderr


def test_a_wheel_in_an_empty_environment_runs_the_page_on_notebooks(new, project, tmp_path):
    python, packages = new
    pip("wheel", "--no-deps", "--wheel-dir", tmp_path, project)
    pip("--python", python, "install", *tmp_path.glob("*.whl"))
    used = run(python, "-I", "-c", RUN_THE_PAGE, PAGE, cwd=tmp_path)
    assert used.returncode == 0, used.stdout + used.stderr
    assert used.stdout == f"{packages / 'pendula/__init__.py'}\n"
