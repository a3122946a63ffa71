"""Every dataset of a full run explains itself, and one name means one thing in all of them."""

from collections import defaultdict

import netCDF4
from helpers import ROOT
from latticode.datasets.netcdf import read
from latticode.datasets.registry import NAMES, UNITS
from latticode.datasets.stated import COMPUTED_FROM

NOT_COMPUTED = {"figures/fig1", "checks/identities"}
"""A drawing of the chain, and algebra for all constants."""


def test_every_dataset_explains_itself_and_a_name_has_one_meaning(full_run):
    paths, meanings = sorted((full_run / "results").rglob("*.nc")), defaultdict(set)
    assert len(paths) > 60
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


def test_every_dataset_says_with_what_it_was_computed_or_names_datasets_that_do(full_run):
    results = full_run / "results"
    for path in sorted(results.rglob("*.nc")):
        about = read(path).attrs
        name = path.relative_to(results).with_suffix("").as_posix()
        sources = about.get(COMPUTED_FROM, "").split(", ")
        for source in filter(None, sources):
            assert (results / f"{source}.nc").exists() or (ROOT / f"{source}.nc").exists(), name
        # without names of others it says itself what was computed, not only how well
        own = {"epsilon", "gamma", "seed", "case", "problems"} & about.keys()
        assert own or any(sources) or name in NOT_COMPUTED, name
