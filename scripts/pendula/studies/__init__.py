"""The studies: each has a folder here, rules in workflow/rules, and a configuration of its own."""

from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

STUDIES = (
    *("paper", "theory", "chaos", "breathers", "newton", "unbounded", "certified"),
    *("hard_cases", "reference"),
)
"""The studies whose claims and settings are collected, in the order in which they are
told. A study with a module `settings` has its choices in config/<name>.yaml."""


def modules(part: str) -> dict[str, ModuleType]:
    """Return the module of this name, such as "settings", of each of STUDIES that has one."""
    names = {study: f"pendula.studies.{study}.{part}" for study in STUDIES}
    return {study: import_module(name) for study, name in names.items() if find_spec(name)}


def all_modules(part: str) -> Iterator[ModuleType]:
    """Yield the modules of STUDIES whose names start with this, such as "claims".

    Those of one study alone have its name before, as in "paper/claims".
    """
    for path in files_of_part(part):
        yield import_module(f"{__name__}.{path.parent.name}.{path.stem}")


def files_of_part(part: str) -> list[Path]:
    """Return the files of the modules that `all_modules` yields."""
    here, (alone, _, start) = Path(__file__).parent, part.rpartition("/")
    studies = [alone] if alone else STUDIES
    return [path for study in studies for path in sorted((here / study).glob(f"{start}*.py"))]
