"""The studies: each has a folder here, rules in workflow/rules, and a configuration of its own."""

from importlib import import_module
from importlib.util import find_spec
from types import ModuleType

STUDIES = ("paper", "theory", "chaos", "unbounded", "hard_cases")
"""The studies whose claims and sections are collected, in the order in which they are told."""

CONFIGURED = ("theory", "chaos", "unbounded", "reference")
"""Studies with choices of their own: config/<name>.yaml holds them, <name>/settings.py says what
may stand in it."""


def modules(part: str) -> dict[str, ModuleType]:
    """Return the module of this name, such as "section", of each of STUDIES that has one."""
    names = {study: f"pendula.studies.{study}.{part}" for study in STUDIES}
    return {study: import_module(name) for study, name in names.items() if find_spec(name)}
