"""The library is built as its README says: who may import whom, and how large it may be."""

from latticode.kernels import sources
from rooms import Rooms

LIBRARY = sources.ROOTS["latticode"] / "latticode"
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
    *(f"simulation/{n}.py" for n in ("__init__", "problem", "feasibility", "survey")),
    *(f"datasets/{n}.py" for n in ("__init__", "netcdf")),
]
"""What the configuration takes of rooms above it: a problem, which no solver can follow, and how
a file of initial data is read."""
MOST_ENTRIES = 14


ROOMS = Rooms(LIBRARY, STOREYS)
MODULES = ROOMS.modules


def test_an_import_points_down():
    assert len(ROOMS.between()) > 60
    assert [pair for pair in ROOMS.upwards() if pair[1] not in FOR_ALL] == []


def test_nothing_is_imported_from_a_program_that_uses_the_library():
    """Nor from a workflow engine: whoever starts runs is above the library."""
    for module in MODULES:
        text = (LIBRARY / module).read_text()
        for name in ("pendula", "snakemake", "benchmarks"):
            assert f"import {name}" not in text and f"from {name}" not in text, module


def test_a_folder_can_be_seen_at_one_glance():
    folders = {module.parent for module in MODULES}
    entries = {
        folder: len(
            {
                module.relative_to(folder).parts[0]
                for module in MODULES
                if module.is_relative_to(folder) and module.name != "__init__.py"
            }
        )
        for folder in folders
    }
    assert {str(folder): n for folder, n in entries.items() if n > MOST_ENTRIES} == {}


def test_the_library_stays_small():
    """More than that nobody keeps in mind: merge what is read together before adding a part."""
    assert ROOMS.lines(MODULES) <= 19_130
