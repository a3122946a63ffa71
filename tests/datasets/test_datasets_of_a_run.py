"""Every dataset of a full run explains itself, and one name means one thing in all of them."""

from collections import defaultdict
from pathlib import Path

import netCDF4
from helpers import MY_BASELINE, ROOT
from latticode.datasets.json_files import load_json
from latticode.datasets.netcdf import read
from latticode.datasets.registry import NAMES, UNITS
from latticode.datasets.stated import COMPUTED_FROM
from replication.figure_diff.chaos import Chaos, cases_of
from replication.variables import ALONG, ALWAYS, BOUND, CHAOS, KIND, NO, STATISTIC, YES


def datasets_of(run: Path) -> list[Path]:
    """Return the datasets that a run computed: those in `quoted` are copies of accepted ones."""
    paths = sorted((run / "results").rglob("*.nc"))
    return [path for path in paths if "quoted" not in path.parts]


NOT_COMPUTED = {"figures/fig1", "checks/identities"}
"""A drawing of the chain, and algebra for all constants."""


def test_every_dataset_explains_itself_and_a_name_has_one_meaning(full_run):
    paths, meanings = datasets_of(full_run), defaultdict(set)
    assert len(paths) > 60
    for path in paths:
        with netCDF4.Dataset(path) as data:
            attrs = {key: data.getncattr(key) for key in data.ncattrs()}
            assert all(attrs[key] for key in ("title", "Conventions", "version", "history")), path
            assert " " in attrs["title"], f"the title of {path} is a single word"
            for name, variable in data.variables.items():
                assert variable.units in UNITS, (path, name)
                assert variable.long_name.startswith(NAMES.get(name, "")), (path, name)
                meanings[name].add((variable.long_name, variable.units))
    several = {name: texts for name, texts in meanings.items() if len(texts) > 1}
    assert {name: texts for name, texts in several.items() if name not in NAMES} == {}


def test_every_variable_says_whether_it_rests_on_chaos_or_is_of_a_known_case(full_run):
    """Else `figure_diff` would not compare it: the maker writes the attribute rests_on_chaos."""
    results = full_run / "results"
    configuration = load_json(full_run / MY_BASELINE / "hashes.json")["configuration"]
    chaos = Chaos({}, cases=cases_of(configuration), time="tau")
    names = [path.relative_to(results).as_posix() for path in datasets_of(full_run)]
    silent = {name: chaos.undeclared(name, read(results / name)) for name in names}
    assert {name: variables for name, variables in silent.items() if variables} == {}


def test_attributes_on_chaos_and_on_kinds_have_known_values(full_run):
    used = defaultdict(set)
    for path in datasets_of(full_run):
        data = read(path)
        for name, attributes in [
            ("", data.attrs),
            *((n, v.attrs) for n, v in data.variables.items()),
        ]:
            for key in {CHAOS, KIND} & attributes.keys():
                used[key].add(attributes[key])
            if str(attributes.get(CHAOS, "")).startswith(ALONG):
                assert attributes[CHAOS].removeprefix(ALONG) in data, (path, name)
    assert used[CHAOS] == {NO, YES, ALWAYS, "along omega"}
    assert used[KIND] == {BOUND, STATISTIC}


def test_every_dataset_says_with_what_it_was_computed_or_names_datasets_that_do(full_run):
    results = full_run / "results"
    for path in datasets_of(full_run):
        attrs = read(path).attrs
        name = path.relative_to(results).with_suffix("").as_posix()
        sources = attrs.get(COMPUTED_FROM, "").split(", ")
        for source in filter(None, sources):
            assert (results / f"{source}.nc").exists() or (ROOT / f"{source}.nc").exists(), name
        # without names of others it says itself what was computed, not only how well
        settings = {"epsilon", "gamma", "seed", "case", "problems"} & attrs.keys()
        assert settings or any(sources) or name in NOT_COMPUTED, name
