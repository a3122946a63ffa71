"""Every dataset of a full run explains itself, and one name means one thing in all of them."""

from collections import defaultdict

import netCDF4
import pytest
from pendula.datasets.registry import NAMES, UNITS

STATED = ("title", "Conventions", "version", "history")


@pytest.fixture(scope="module")
def datasets(full_run):
    """Return the attributes and the described variables of every dataset, by its path."""
    found = {}
    for path in sorted((full_run / "results").rglob("*.nc")):
        with netCDF4.Dataset(path) as data:
            attributes = {name: data.getncattr(name) for name in data.ncattrs()}
            about = {name: (v.long_name, v.units) for name, v in data.variables.items()}
            found[path.relative_to(full_run / "results").as_posix()] = attributes, about
    return found


def test_every_dataset_says_what_it_is(datasets):
    assert len(datasets) > 100
    for name, (attributes, _) in datasets.items():
        assert all(attributes.get(key) for key in STATED), name
        assert " " in attributes["title"], f"{name} has no title in words"


def test_every_variable_has_units_that_are_known(datasets):
    for name, (_, variables) in datasets.items():
        assert all(units in UNITS for _, units in variables.values()), name


def test_one_name_has_one_meaning(datasets):
    meanings = defaultdict(lambda: defaultdict(list))
    for path, (_, variables) in datasets.items():
        for name, meaning in variables.items():
            meanings[name][meaning].append(path)
    twice = {name: dict(found) for name, found in meanings.items() if len(found) > 1}
    assert {name: found for name, found in twice.items() if name not in NAMES} == {}


def test_a_name_of_the_registry_keeps_its_meaning(datasets):
    for path, (_, variables) in datasets.items():
        for name, (long_name, _) in variables.items():
            assert long_name.startswith(NAMES.get(name, "")), f"{path}: {name}: {long_name}"
