"""Words that fit any value are less than 1 % of the names that a folder of code binds."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest
from helpers import ROOT

WORDS = """
    one ones other others own owns found given giving taken takes kept keeps told tells said says
    shown wanted whole rest made makes making about here there thing things part parts piece what
    which such whose again still like alike beside apart bare plain
"""
VAGUE = frozenset(WORDS.split())
"""Words that fit any value."""
PERCENT = 1.0
"""The limit. In five codebases of this field the share is 0.0 to 0.3 %."""

ROOMS = (
    "scripts",
    "packages/latticode/latticode",
    "packages/snakemake-executor-plugin-forked/snakemake_executor_plugin_forked",
    "benchmarks",
    "docs",
    "tests",
    "packages/latticode/tests",
    "packages/snakemake-executor-plugin-forked/tests",
)
"""The folders and modules that are checked."""

EXCEPTIONS: dict[tuple[str, str], str] = {}
"""By (file, name): why this name is the right one there."""


def bound_names(text: str) -> Iterator[tuple[str, int]]:
    """Yield each name that a module binds, with its line: arguments, variables, functions."""
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Name(id=name, ctx=ast.Store()) | ast.arg(arg=name):
                yield name, node.lineno
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                yield node.name, node.lineno


def is_vague(name: str) -> bool:
    """Return whether a name is made of one or two vague words."""
    words = name.lower().strip("_").split("_")
    return len(words) <= 2 and VAGUE.issuperset(words)


def modules_of(room: str) -> list[Path]:
    """Return the modules of a room, which is a folder or one module, without tests inside it."""
    top = ROOT / room
    paths = [top] if top.is_file() else sorted(top.rglob("*.py"))
    return [path for path in paths if not {"tests", "build"} & set(path.relative_to(top).parts)]


@pytest.mark.parametrize("room", ROOMS)
def test_few_names_are_vague(room):
    total, vague = 0, []
    for path in modules_of(room):
        module = str(path.relative_to(ROOT))
        names = list(bound_names(path.read_text()))
        total += len(names)
        vague += [
            f"{module}:{line} {name}"
            for name, line in names
            if is_vague(name) and (module, name) not in EXCEPTIONS
        ]
    share = 100.0 * len(vague) / total
    assert share < PERCENT, f"{share:.1f} % of {room}: name what these hold\n" + "\n".join(vague)


def test_exceptions_are_still_there():
    for module, name in EXCEPTIONS:
        assert name in dict(bound_names((ROOT / module).read_text())), (module, name)


def test_a_vague_name_is_detected():
    text = "def given(path, other=1):\n    found = [one for one in path]\n    return found_by\n"
    vague = {name for name, _ in bound_names(text) if is_vague(name)}
    assert vague == {"given", "other", "found", "one"}
