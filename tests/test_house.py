"""The replication is built as ARCHITECTURE.md says: who imports whom, how large, by what means."""

import re
from pathlib import Path

import pytest
from helpers import ROOT
from operators import used_in
from pendula.sources import SCRIPTS
from pendula.studies import STUDIES
from rooms import Rooms, circles_in

LIBRARY = SCRIPTS / "pendula"
STOREYS = (
    ("workflow",),
    ("notebook",),
    ("article", "own_cases"),
    ("live",),
    ("jobs",),
    ("studies",),
    ("claims",),
    ("drawing", "case_words"),
    ("many_cases", "varied"),
    ("configuration",),
    ("contract",),
    ("models", "feasibility", "problem", "names"),
    ("sources",),
)
"""The rooms from the top down: an import points down, or stays in its room."""

COLLECTORS = ("configuration",)
"""Rooms that reach the studies by their list alone, without a name of one."""
THE_LIST = Path("studies/__init__.py")


ROOMS = Rooms(LIBRARY, STOREYS)
MODULES = ROOMS.modules
GENERAL = Rooms(
    SCRIPTS / "replication",
    (
        ("article",),
        ("figure_diff", "archive"),
        ("report",),
        ("ledger",),
        ("results",),
        ("words", "differences", "variables", "logs"),
    ),
)
"""The rooms that any replication has."""


def test_an_import_points_down():
    assert len(ROOMS.between()) > 100
    the_list = [
        (module, str(THE_LIST)) for module, _ in ROOMS.upwards() if module.startswith(COLLECTORS)
    ]
    assert [pair for pair in ROOMS.upwards() if pair not in the_list] == []


def test_the_general_rooms_know_nothing_of_the_paper_and_import_in_no_circle():
    """Another paper can use them: nothing there imports `pendula`, or has its name."""
    assert GENERAL.upwards() == [] and len(GENERAL.between()) > 20
    for path in (SCRIPTS / "replication").rglob("*"):
        if path.is_file() and path.suffix != ".pyc":
            assert "pendula" not in path.read_text(encoding="utf-8"), path


def test_no_study_uses_the_code_of_another():
    inside = {
        pair
        for pair in ROOMS.imports()
        if pair[0].parts[0] == pair[1].parts[0] == "studies" and pair[1] != THE_LIST
    }
    assert len(inside) > 50
    assert [pair for pair in inside if pair[0].parts[1] != pair[1].parts[1]] == []


def test_what_all_share_stays_small():
    """More than that nobody keeps in mind: merge what is read together before adding a part."""
    shared = [module for module in MODULES if module.parts[0] != "studies"]
    shared_lines = ROOMS.lines(shared) + GENERAL.lines(GENERAL.modules)
    assert len(shared) + len(GENERAL.modules) <= 131 and shared_lines <= 16_900


def test_a_study_can_be_read_in_a_day():
    """A study is read alone; one that outgrows this asks two questions, and is two studies."""
    of_each = [[m for m in MODULES if m.parts[:2] == ("studies", study)] for study in STUDIES]
    sizes = {modules[0].parts[1]: (len(modules), ROOMS.lines(modules)) for modules in of_each}
    assert {name: (n, lines) for name, (n, lines) in sizes.items() if n > 24 or lines > 3_500} == {}


MAY_DIFFER = ("drawing",)
"""Rooms that write texts and pictures for people, of rounded numbers."""
ALLOWED = {
    ("studies/certified/fixed_point.py", "**"): "powers of integers, which are exact",
    ("studies/breathers/multipliers.py", "@"): "rates are rounded before they are stored",
}
"""What a module may use, with the reason."""


def test_operators_have_the_same_bits_on_every_processor():
    """Each use stands in ALLOWED, and what is allowed is still used.

    The tests of the library say which these are: packages/latticode/tests/test_operators.py.
    """
    assert used_in(LIBRARY, MAY_DIFFER) == ALLOWED.keys()
    assert used_in(SCRIPTS / "replication", ("report", "figure_diff", "archive", "words")) == set()


INSIDE = ("inside_numba.py", "test_inside_numba.py", "inside.py")
"""What looks inside numba, and inside Snakemake: each says on top what it rests upon, and why."""
HIDDEN = re.compile(
    r"^ *(?:from|import) (?:"
    r"numba\.core(?! import (?:cgutils|errors|event)\b|\.(?:cgutils|errors)\b)"
    r"|snakemake\.(?!(?:api|utils|logging|exceptions|settings|script)\b))",
    re.MULTILINE,
)


def test_dependencies_are_used_by_their_front_door():
    """A module that is not public works until the next release, and then fails in an odd place."""
    folders = ("scripts", "workflow", "packages", "benchmarks", "docs", "tests")
    modules = {path for folder in folders for path in (ROOT / folder).rglob("*.py")}
    modules = {path for path in modules if path.name not in INSIDE and "build" not in path.parts}
    assert len(modules) > 250
    assert [str(path) for path in modules if HIDDEN.search(path.read_text())] == []
    assert HIDDEN.search("from numba.core.caching import _Cache")
    assert HIDDEN.search("    from snakemake.dag import DAG")


@pytest.mark.parametrize("package", ["pendula", "replication"])
def test_no_modules_import_each_other_in_a_circle(package):
    """Imports inside functions count too."""
    assert circles_in(SCRIPTS / package) == []
