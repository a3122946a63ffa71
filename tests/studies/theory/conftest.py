"""The checks of the full reproduction, each run once for all tests."""

from functools import cache

import pytest
from helpers import chosen
from pendula.studies.theory.checks import run_check


@pytest.fixture(scope="session")
def checked():
    """Return a function: the numbers of a check by its name."""
    section = chosen("theory")
    return cache(lambda name: run_check(name, getattr(section, name).model_dump()))


@pytest.fixture(scope="session")
def numbers(checked):
    """Return a function: the values of one variable of a check."""
    return lambda name, variable: checked(name)["data_vars"][variable]["data"]
