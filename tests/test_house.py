"""The library is built as ARCHITECTURE.md says: who may import whom, and how large it may be."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from latticode.kernels import sources
from pendula.sources import SCRIPTS
from pendula.studies import STUDIES

LIBRARY = SCRIPTS / "pendula"
MODULES = sorted(path.relative_to(LIBRARY) for path in LIBRARY.rglob("*.py"))

STOREYS = (
    ("live",),
    ("notebook",),
    ("article", "own_cases"),
    ("studies",),
    ("report", "figure_diff", "archive", "ledger"),
    ("drawing",),
    ("many_cases",),
    ("configuration",),
    ("models", "feasibility", "problem", "names"),
    ("sources",),
)
"""The rooms from the top down: an import points down, or stays in its room."""

COLLECTORS = ("report", "ledger", "archive", "configuration")
"""Rooms that reach the studies by their list alone, without a name of one."""
THE_LIST = Path("studies/__init__.py")


def room_of(parts: tuple[str, ...]) -> str:
    return parts[0].removesuffix(".py")


def storey_of(room: str) -> int:
    return next(i for i, rooms in enumerate(STOREYS) if room in rooms)


@cache
def imports_of(module: Path) -> list[Path]:
    """Return the modules of the library that a module imports, and the packages around them."""
    files = sources._imports_of(LIBRARY / module)
    return [file.relative_to(LIBRARY) for file in files if file.is_relative_to(LIBRARY)]


def imports_between_rooms() -> Iterator[tuple[str, str, str]]:
    """Yield the room that imports, the room that it imports from, and the import in words."""
    for module in MODULES:
        room = room_of(module.parts)
        for imported in imports_of(module):
            other = room_of(imported.parts)
            of_the_list = room in COLLECTORS and imported == THE_LIST
            if not {"__init__"} & {room, other} and other != room and not of_the_list:
                yield room, other, f"{module} imports {imported}"


def test_an_import_points_down():
    found = list(imports_between_rooms())
    assert len(found) > 100
    assert [told for room, other, told in found if storey_of(other) < storey_of(room)] == []


def test_no_study_uses_the_code_of_another():
    inside = {
        (module, imported)
        for module in MODULES
        for imported in imports_of(module)
        if module.parts[0] == imported.parts[0] == "studies" and imported != THE_LIST
    }
    assert len(inside) > 100
    assert [pair for pair in inside if pair[0].parts[1] != pair[1].parts[1]] == []


def lines_of(modules) -> int:
    return sum(len((LIBRARY / module).read_text().splitlines()) for module in modules)


def test_what_all_share_stays_small():
    """More than that nobody keeps in mind: merge what is read together before adding a part."""
    shared = [module for module in MODULES if module.parts[0] != "studies"]
    assert len(shared) <= 130 and lines_of(shared) <= 16_900


def test_a_study_can_be_read_in_a_day():
    """A study is read alone; one that outgrows this asks two questions, and is two studies."""
    of_each = [[m for m in MODULES if m.parts[:2] == ("studies", study)] for study in STUDIES]
    sizes = {modules[0].parts[1]: (len(modules), lines_of(modules)) for modules in of_each}
    assert {name: (n, lines) for name, (n, lines) in sizes.items() if n > 24 or lines > 3_500} == {}
