"""The library is built as ARCHITECTURE.md says: who may import whom, and how large it may be."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from pendula import sources
from pendula.studies import STUDIES

LIBRARY = sources.SCRIPTS / "pendula"
MODULES = sorted(path.relative_to(LIBRARY) for path in LIBRARY.rglob("*.py"))

STOREYS = (
    ("notebook",),
    ("article", "own_cases"),
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
    ("problem",),
    ("model", "ends"),
    ("symbols",),
    ("graph",),
    ("simd", "compiled", "inside_numba", "kernel_cache", "numerics", "sources"),
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
    # test_project.py holds these trees to have every import
    for node in sources._statements(sources._tree_of((LIBRARY / module).read_text())):
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


def imports_between_rooms() -> Iterator[tuple[str, str, str]]:
    """Yield the room that imports, the room that it imports from, and the import in words."""
    for module in MODULES:
        room = room_of(module.parts)
        for imported in imports_of(module):
            other = room_of(imported)
            of_the_list = room in COLLECTORS and imported in THE_LIST
            if room != "__init__" and other not in ("__version__", room) and not of_the_list:
                yield room, other, f"{module} imports {'.'.join(imported)}"


def test_an_import_points_down():
    found = list(imports_between_rooms())
    assert len(found) > 100
    assert [told for room, other, told in found if storey_of(other) < storey_of(room)] == []


def test_no_study_uses_the_code_of_another():
    inside = {
        (module, imported)
        for module in MODULES
        for imported in imports_of(module)
        if module.parts[0] == imported[0] == "studies" and min(len(module.parts), len(imported)) > 2
    }
    assert len(inside) > 100
    assert [pair for pair in inside if pair[0].parts[1] != pair[1][1]] == []


def lines_of(modules) -> int:
    return sum(len((LIBRARY / module).read_text().splitlines()) for module in modules)


def test_what_all_share_stays_small():
    """More than that nobody keeps in mind: merge what is read together before adding a part."""
    shared = [module for module in MODULES if module.parts[0] != "studies"]
    assert len(shared) <= 129 and lines_of(shared) <= 16_650


def test_a_study_can_be_read_in_a_day():
    """A study is read alone; one that outgrows this asks two questions, and is two studies."""
    of_each = [[m for m in MODULES if m.parts[:2] == ("studies", study)] for study in STUDIES]
    sizes = {modules[0].parts[1]: (len(modules), lines_of(modules)) for modules in of_each}
    assert {name: (n, lines) for name, (n, lines) in sizes.items() if n > 24 or lines > 4_380} == {}
