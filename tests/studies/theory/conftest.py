"""The checks at the sizes of the quick run, each run once for all tests."""

from functools import cache

import pytest
from helpers import chosen
from pendula.studies.theory.checks import run_check
from pendula.studies.theory.settings import GROUPS


@pytest.fixture(scope="session")
def checked():
    """Return a function: the numbers of a check by its name."""
    section = chosen("theory", "quick")
    groups = section.wrong_arguments(), *map(section.arguments, GROUPS)
    arguments = {name: given for group in groups for name, given in group.items()}
    return cache(lambda name: run_check(name, arguments[name]))


@pytest.fixture(scope="session")
def numbers(checked):
    """Return a function: the values of one variable of a check, or of one coordinate."""
    return lambda name, variable, kind="data_vars": checked(name)[kind][variable]["data"]
