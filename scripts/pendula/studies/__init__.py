"""The studies: one folder each, with rules in workflow/rules and keys in config/."""

from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

STUDIES = (
    "paper",
    "theory",
    "chaos",
    "breathers",
    "newton",
    "unbounded",
    "certified",
    "hard_cases",
    "reference",
)
"""All studies, in the order of their claims in the ledger. Keys of a study with a module `settings`
are in config/<name>.yaml."""


def modules_named(stem: str) -> dict[str, ModuleType]:
    """Return the modules called `stem`, such as "settings", of the studies that have one."""
    names = {study: f"pendula.studies.{study}.{stem}" for study in STUDIES}
    return {study: import_module(name) for study, name in names.items() if find_spec(name)}


def modules_with_prefix(prefix: str) -> Iterator[ModuleType]:
    """Yield the modules of all studies whose names start with `prefix`, such as "claims".

    A prefix that begins with a study, as in "paper/claims", yields only modules of this study.
    """
    for path in files_with_prefix(prefix):
        yield import_module(f"{__name__}.{path.parent.name}.{path.stem}")


def files_with_prefix(prefix: str) -> list[Path]:
    """Return the files of the modules that `modules_with_prefix` yields."""
    folder, (only_study, _, start) = Path(__file__).parent, prefix.rpartition("/")
    studies = [only_study] if only_study else STUDIES
    return [path for study in studies for path in sorted((folder / study).glob(f"{start}*.py"))]
