"""Every dataset of a full run explains itself, and one name means one thing in all of them."""

from collections import defaultdict

import netCDF4
from pendula.datasets.registry import NAMES, UNITS


def test_every_dataset_explains_itself_and_a_name_has_one_meaning(full_run):
    paths, meanings = sorted((full_run / "results").rglob("*.nc")), defaultdict(set)
    assert len(paths) > 100
    for path in paths:
        with netCDF4.Dataset(path) as data:
            about = {key: data.getncattr(key) for key in data.ncattrs()}
            assert all(about[key] for key in ("title", "Conventions", "version", "history")), path
            assert " " in about["title"], f"the title of {path} is a single word"
            for name, variable in data.variables.items():
                assert variable.units in UNITS, (path, name)
                assert variable.long_name.startswith(NAMES.get(name, "")), (path, name)
                meanings[name].add((variable.long_name, variable.units))
    several = {name: found for name, found in meanings.items() if len(found) > 1}
    assert {name: found for name, found in several.items() if name not in NAMES} == {}
