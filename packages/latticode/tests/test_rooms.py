"""The library is built as its README says: who may import whom, and how large it may be."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from latticode.kernels import sources

LIBRARY = sources.ROOTS["latticode"] / "latticode"
MODULES = sorted(path.relative_to(LIBRARY) for path in LIBRARY.rglob("*.py"))
STOREYS = (
    ("notebook",),
    ("drawing", "checks"),
    ("datasets",),
    ("localised",),
    ("simulation",),
    ("configuration",),
    ("generation",),
    ("integrators", "measures"),
    ("equations",),
    ("kernels", "numerics"),
)
"""The rooms from the top down: an import points down, or stays in its room."""
FOR_ALL = [
    f"simulation/{n}.py" for n in ("__init__", "problem", "feasibility", "survey", "ensembles")
]
"""What the configuration takes of a room above it: a problem, and which no solver can follow."""
MOST_ENTRIES = 13


def room_of(module: Path) -> str:
    return module.parts[0].removesuffix(".py")


@cache
def imports_of(module: Path) -> list[Path]:
    files = sources._imports_of(LIBRARY / module)
    return [file.relative_to(LIBRARY) for file in files if file.is_relative_to(LIBRARY)]


def storey_of(room: str) -> int:
    return next(i for i, rooms in enumerate(STOREYS) if room in rooms)


def imports_between_rooms() -> Iterator[tuple[str, str, str]]:
    """Yield the room that imports, the room that it imports from, and the import in words."""
    for module in MODULES:
        for imported in imports_of(module):
            rooms = room_of(module), room_of(imported)
            if "__init__" not in rooms and rooms[0] != rooms[1]:
                yield *rooms, f"{module} imports {imported}"


def test_an_import_points_down():
    found = list(imports_between_rooms())
    assert len(found) > 60
    wrong = [told for room, other, told in found if storey_of(other) < storey_of(room)]
    assert [told for told in wrong if not told.endswith(tuple(FOR_ALL))] == []


def test_nothing_is_imported_from_a_program_that_uses_the_library():
    """Nor from a workflow engine: whoever starts runs is above the library."""
    for module in MODULES:
        text = (LIBRARY / module).read_text()
        for name in ("pendula", "snakemake", "benchmarks"):
            assert f"import {name}" not in text and f"from {name}" not in text, module


def test_a_folder_can_be_seen_at_one_glance():
    folders = {module.parent for module in MODULES}
    entries = {
        folder: len({other.relative_to(folder).parts[0] for other in MODULES
                     if other.is_relative_to(folder) and other.name != "__init__.py"})
        for folder in folders
    }  # fmt: skip
    assert {str(folder): n for folder, n in entries.items() if n > MOST_ENTRIES} == {}


def test_the_library_stays_small():
    """More than that nobody keeps in mind: merge what is read together before adding a part."""
    lines = sum(len((LIBRARY / module).read_text().splitlines()) for module in MODULES)
    assert lines <= 13_500
