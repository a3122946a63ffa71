"""Dependencies are used by their front door: no private name, no patch, no walk through frames.

Such code works until the next release, and then fails in a place that nobody thinks of. Where numba
or Snakemake have no public way, one module for each uses a private one, see INSIDE.
"""

import ast
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from helpers import ROOT

INSIDE = (
    "scripts/pendula/inside_numba.py",
    "tests/test_inside_numba.py",
    "plugins/snakemake-executor-plugin-forked/snakemake_executor_plugin_forked/inside.py",
)
"""What looks inside numba, and inside Snakemake: each says on top what it rests upon, and why."""
VALIDATOR = "tests/archive/test_metadata.py"
"""Answers in place of the net, which the validator asks even where it is told to be offline."""

NAMED_TUPLES = {"_replace", "_asdict", "_fields", "_make"}
DOCUMENTED = NAMED_TUPLES | {"_exit", "_current_exceptions", "_getvalue"}
"""Public in spite of their underscore, and documented: by Python, and by numba (structures)."""
FRAMES = {"_getframe", "_current_frames", "currentframe", "f_back", "f_locals", "f_globals"}
PUBLIC_OF_SNAKEMAKE = {"api", "utils", "logging", "exceptions", "settings", "script"}
PUBLIC_OF_NUMBA_CORE = {"cgutils", "errors"}
"""What the guide to extending numba uses, and the errors that users meet."""


@cache
def files() -> dict[str, ast.Module]:
    listed = subprocess.run(
        ["git", "ls-files", "--", "*.py"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return {name: ast.parse((ROOT / name).read_text()) for name in listed.stdout.split()}


@cache
def ours() -> set[str]:
    """Return the modules of the project by the name that an import begins with, and Python's."""
    return {Path(name).stem for name in files()} | {
        "pendula",
        "benchmarks",
        *sys.stdlib_module_names,
    }


@cache
def defined() -> set[str]:
    """Return every name that the project gives to a function, a class, or a value of its own."""
    found = set()
    for tree in files().values():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.ClassDef):
                found.add(node.name)
            elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                found.add(node.id)
            elif isinstance(node, ast.Attribute) and ast.unparse(node.value) in ("self", "cls"):
                found |= {node.attr} if isinstance(node.ctx, ast.Store) else set()
    return found


def is_private(name: str) -> bool:
    return name.startswith("_") and not name.endswith("__") and name not in DOCUMENTED


def foreign_imports(tree: ast.Module) -> Iterator[tuple[list[str], str]]:
    """Yield the path of each name that is imported from a dependency, and how it is called here."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom) and not getattr(node, "level", 0):
            module = [] if isinstance(node, ast.Import) else node.module.split(".")
            for alias in node.names:
                path = [*module, *alias.name.split(".")]
                if path[0] not in ours():
                    yield path, alias.asname or path[0 if not module else -1]


def faults(tree: ast.Module) -> Iterator[str]:
    """Yield in words each use of a dependency that is not by its front door."""
    imported = set()
    for path, name in foreign_imports(tree):
        imported.add(name)
        inside = {
            "snakemake": path[1:] and path[1] not in PUBLIC_OF_SNAKEMAKE,
            "numba": path[1:2] == ["core"] and not PUBLIC_OF_NUMBA_CORE.intersection(path[2:3]),
        }
        if inside.get(path[0]) or any(map(is_private, path)):
            yield f"imports {'.'.join(path)}"
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            if node.attr in FRAMES:
                yield f"line {node.lineno} looks at frames: {ast.unparse(node)}"
            elif is_private(node.attr) and node.attr not in defined():
                yield f"line {node.lineno} uses {ast.unparse(node)}"
            elif isinstance(node.ctx, ast.Store) and is_of(imported, node.value):
                yield f"line {node.lineno} patches {ast.unparse(node)}"
        elif isinstance(node, ast.Call) and node.args and is_of(imported, node.args[0]):
            called = ast.unparse(node.func).split(".")[-1]
            if called in ("setattr", "delattr", "object"):
                yield f"line {node.lineno} patches {ast.unparse(node.args[0])}"


def is_of(imported: set[str], owner: ast.expr) -> bool:
    """Return whether an object is one of `imported`, or a part of it, and no settings."""
    name = ast.unparse(owner)
    return name.split(".")[0] in imported and name not in ("numba.config", "matplotlib.rcParams")


def test_dependencies_are_used_by_their_front_door():
    looked_at = [name for name in files() if name not in (*INSIDE, VALIDATOR)]
    assert len(looked_at) > 300
    found = [f"{name} {fault}" for name in looked_at for fault in faults(files()[name])]
    assert found == []


@pytest.mark.parametrize(
    "code",
    [
        "from matplotlib._mathtext import Parser",
        "from numba.core.caching import _Cache",
        "from numba.core import registry",
        "from snakemake.dag import DAG",
        "axis._update_ticks()",
        "import numba\nnumba.njit = None",
        "import numba\nsetattr(numba, 'njit', None)",
        "import numba\nmonkeypatch.setattr(numba, 'njit', None)",
        "import sys\nsys._getframe(1)",
        "frame.f_back",
    ],
)
def test_each_way_through_the_back_door_is_seen(code):
    assert len([*faults(ast.parse(code))]) == 1


@pytest.mark.parametrize(
    "code", ["import numpy as np\nnp.zeros(2)", "pair._replace(a=1)", "from .seal import _seal"]
)
def test_what_is_public_or_ours_is_no_fault(code):
    assert [*faults(ast.parse(code))] == []
