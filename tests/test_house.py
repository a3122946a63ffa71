"""The library is built as ARCHITECTURE.md says: who may import whom, and how large it may be."""

from pathlib import Path

from pendula.sources import SCRIPTS
from pendula.studies import STUDIES
from rooms import Rooms

LIBRARY = SCRIPTS / "pendula"
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


ROOMS = Rooms(LIBRARY, STOREYS)
MODULES = ROOMS.modules


def test_an_import_points_down():
    assert len(ROOMS.between()) > 100
    the_list = [(module, str(THE_LIST)) for module, _ in ROOMS.upwards()
                if module.startswith(COLLECTORS)]  # fmt: skip
    assert [pair for pair in ROOMS.upwards() if pair not in the_list] == []


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
    assert len(shared) <= 130 and ROOMS.lines(shared) <= 16_900


def test_a_study_can_be_read_in_a_day():
    """A study is read alone; one that outgrows this asks two questions, and is two studies."""
    of_each = [[m for m in MODULES if m.parts[:2] == ("studies", study)] for study in STUDIES]
    sizes = {modules[0].parts[1]: (len(modules), ROOMS.lines(modules)) for modules in of_each}
    assert {name: (n, lines) for name, (n, lines) in sizes.items() if n > 24 or lines > 3_500} == {}
