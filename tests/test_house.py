"""The library is built as ARCHITECTURE.md says: who may import whom, and how large it may be."""

import ast
from functools import cache
from pathlib import Path

import pytest
from pendula.sources import SCRIPTS
from pendula.studies import STUDIES

LIBRARY = SCRIPTS / "pendula"
MODULES = sorted(path.relative_to(LIBRARY) for path in LIBRARY.rglob("*.py"))

STOREYS = (
    ("notebook",),
    ("own_cases",),
    ("studies",),
    ("report", "figure_diff", "archive", "ledger"),
    ("drawing",),
    ("datasets",),
    ("simulation",),
    ("models",),
    ("integrators",),
    ("measures",),
    ("configuration",),
    ("feasibility",),
    ("simd", "compiled", "kernel_parts", "kernel_cache", "numerics", "sources", "spent", "problem"),
)
"""The rooms from the top down: an import points down, or stays in its room."""

COLLECTORS = ("report", "ledger", "archive", "configuration")
"""Rooms that reach the studies by their list alone, without a name of one."""

THE_LIST = {("studies",), *(("studies", name) for name in ("STUDIES", "modules"))}


def room_of(parts: tuple[str, ...]) -> str:
    return parts[0].removesuffix(".py")


def storey_of(room: str) -> int:
    return next(i for i, rooms in enumerate(STOREYS) if room in rooms)


@cache
def imports_of(module: Path) -> tuple[tuple[str, ...], ...]:
    """Return what a module imports of the library, each as its parts below pendula."""
    found = []
    for node in ast.walk(ast.parse((LIBRARY / module).read_text())):
        if isinstance(node, ast.ImportFrom):
            package = module.parts[: len(module.parts) - node.level] if node.level else ()
            named = tuple(node.module.split(".")) if node.module else ()
            if node.level or named[:1] == ("pendula",):
                base = (*package, *(named if node.level else named[1:]))
                found += [(*base, alias.name) for alias in node.names]
        elif isinstance(node, ast.Import):
            names = (tuple(alias.name.split(".")) for alias in node.names)
            found += [name[1:] for name in names if name[0] == "pendula"]
    return tuple(found)


@pytest.mark.parametrize("module", MODULES, ids=str)
def test_an_import_points_down(module):
    room = room_of(module.parts)
    if room == "__init__":
        return
    for imported in imports_of(module):
        other = room_of(imported)
        if other in ("__version__", room) or (room in COLLECTORS and imported in THE_LIST):
            continue
        assert storey_of(other) >= storey_of(room), f"{module} imports {'.'.join(imported)}"


@pytest.mark.parametrize("module", [m for m in MODULES if m.parts[0] == "studies"], ids=str)
def test_no_study_uses_the_code_of_another(module):
    for imported in imports_of(module):
        if imported[0] == "studies" and len(imported) > 2 and len(module.parts) > 2:
            assert imported[1] == module.parts[1], f"{module} imports {'.'.join(imported)}"


def lines_of(modules) -> int:
    return sum(len((LIBRARY / module).read_text().splitlines()) for module in modules)


def test_what_all_share_stays_small():
    """More than that nobody keeps in mind: merge what is read together before adding a part."""
    shared = [module for module in MODULES if module.parts[0] != "studies"]
    assert len(shared) <= 118 and lines_of(shared) <= 15_640


@pytest.mark.parametrize("study", STUDIES)
def test_a_study_can_be_read_in_a_day(study):
    """A study is read alone; one that outgrows this asks two questions, and is two studies."""
    modules = [module for module in MODULES if module.parts[:2] == ("studies", study)]
    assert len(modules) <= 24 and lines_of(modules) <= 4_380
