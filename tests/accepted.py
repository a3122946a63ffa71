"""The accepted results as the data of tests: datasets by name, and wrong changes of them."""

import json
import math
import re
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

import numpy as np
import xarray as xr
import yaml
from pendula.configuration.files import gather
from pendula.configuration.messages import STUDIES, load
from pendula.datasets.netcdf import read
from pendula.ledger.changes import exchange, keep, put, scale, shift
from pendula.ledger.section import Ledger
from pendula.report.document import all_sections, write
from pendula.report.page import Picture
from pendula.report.results import Results, Section, Table
from pendula.report.sections import Measured, gather_speed

ROOT = Path(__file__).parents[1]
BASELINE = ROOT / "tests/baseline"


@cache
def dataset(name: str) -> xr.Dataset:
    """Return an accepted dataset such as "checks/lyapunov", which nobody may change in place."""
    return read(BASELINE / f"{name}.nc")


def datasets(names: Iterable[str]) -> dict[str, xr.Dataset]:
    """Return accepted datasets by their names."""
    return {name: dataset(name) for name in names}


def wrong_changes(part: str) -> list[dict]:
    """Return the rows of one part of wrong_changes.yaml, which says how they are written."""
    return yaml.safe_load((Path(__file__).parent / "wrong_changes.yaml").read_text())[part]


def changed(row: Mapping) -> dict[str, xr.Dataset]:
    """Return the datasets that a row of wrong_changes.yaml changes, after the change."""
    given = row.get("in", ())
    names = [given] if isinstance(given, str) else given
    return {name: _change(dataset(row.get("take", name)), row) for name in names}


def _change(data: xr.Dataset, row: Mapping) -> xr.Dataset:
    if "keep" in row:
        data = keep(**_labels(row["keep"]))(data)
    if "exchange" in row:
        data = exchange(row["exchange"])(data)
    for verb, (given, change) in VERBS.items():
        names = [row[verb]] if isinstance(row.get(verb), str) else row.get(verb, ())
        if here := tuple(name for name in names if name in data):
            data = change(here, row[given], **_labels(row.get("at", {})))(data)
    return data


VERBS = {"scale": ("by", scale), "shift": ("by", shift), "set": ("to", put)}


def _labels(at: Mapping) -> dict:
    """Return labels by coordinate, spans {from, to} as slices."""
    return {
        along: slice(wanted.get("from"), wanted.get("to")) if isinstance(wanted, dict) else wanted
        for along, wanted in at.items()
    }


def leaves(found, place: str = "") -> dict:
    """Return what stands in nested lists and dictionaries, by its place."""
    if not isinstance(found, dict | list):
        return {place: found}
    items = found.items() if isinstance(found, dict) else enumerate(found)
    return {at: leaf for key, one in items for at, leaf in leaves(one, f"{place}.{key}").items()}


def differing(one, other, share: float, amount: float = 0.0) -> dict[str, tuple]:
    """Return the leaves in which two things differ, numbers by more than a share and an amount."""
    one, other = leaves(one), leaves(other)
    pairs = {place: (one.get(place), other.get(place)) for place in one | other}

    def alike(a, b) -> bool:
        if {type(a), type(b)} <= {float, int, np.float64}:
            return math.isclose(a, b, rel_tol=share, abs_tol=amount)
        return a == b

    return {place: pair for place, pair in pairs.items() if not alike(*pair)}


def check_words(row: dict, right: str, wrong: str) -> None:
    """Check that words are told by the wrong text alone, and others by the right one alone."""
    assert row.keys() & {"told", "untold"}
    for words, here, elsewhere in (
        (row.get("told"), wrong, right),
        (row.get("untold"), right, wrong),
    ):
        if words:
            assert words in here
            assert words not in elsewhere


class Report(Results):
    """The accepted results as the report reads them; some datasets may be changed.

    References stand in the place of the trajectories that a run makes of them, and a dot in that of
    each picture.
    """

    def __init__(self, changes: Mapping[str, xr.Dataset] = {}, differs: Mapping[str, str] = {}):
        super().__init__([], "", settings(), dict(differs))
        files = [path for path in BASELINE.rglob("*") if path.is_file()]
        self._paths = {path.relative_to(BASELINE).as_posix(): path for path in files}
        self.changes = changes

    def __getitem__(self, name: str) -> xr.Dataset:
        return self.changes[name] if name in self.changes else dataset(_accepted(name))

    def __contains__(self, name: str) -> bool:
        return super().__contains__(_accepted(name))

    def path(self, link: str) -> Path:
        return super().path(_accepted(link))

    def picture(self, name: str, alt: str) -> Picture:
        return Picture("data:,", 1, 1, alt, f"figures/{name}.png")


def _accepted(name: str) -> str:
    return name.replace("truth/", "reference/")


@cache
def settings(*over: str) -> dict:
    """Return the configuration as the sections read it, with the files of these names over it."""
    names = ("config", *STUDIES, *over)
    given = load(gather([ROOT / f"config/{name}.yaml" for name in names], {}))
    swept = {
        name: {**sweep.model_dump(), "drawn": sweep.drawn.model_dump()}
        for name, sweep in given.sweeps.items()
    }
    return {"sweeps": swept} | {name: getattr(given, name).model_dump() for name in STUDIES}


SPEED = Measured("speed/work_precision.nc", "speed/work_precision.md", [], False)


def sections() -> dict[str, Section]:
    """Return the sections of all studies, and that on speed, by name; the ledger has own files."""
    speed = Section("speed", "Speed", lambda results, _: gather_speed(results, SPEED))
    return {one.name: one for one in (speed, *all_sections()) if one.name != "claims"}


def facts(name: str, results: Results) -> dict[str, str]:
    """Return the texts of a section of the report, by their places."""
    return texts(sections()[name].gather(results, Ledger(results)))


def texts(found: Mapping, place: str = "") -> dict[str, str]:
    """Return the texts of a section's parts by their places, each row of a table as one text."""
    said = {}
    for name, part in found.items():
        if isinstance(part, Mapping):
            said |= texts(part, f"{place}{name}.")
        elif isinstance(part, Table):
            rows = {"title": [part.title], "head": part.head} | dict(enumerate(part.rows))
            said |= {f"{place}{name}.{key}": " | ".join(map(str, row)) for key, row in rows.items()}
        else:
            said[f"{place}{name}"] = str(getattr(part, "caption", part))
    return {at: re.sub(r"<[/a-z][^>]*>", "", text) for at, text in said.items()}


def page_of(name: str, results: Results) -> str:
    """Return all words of a page of the report that has this section alone."""
    html = write(results, [sections()[name]])
    told = re.sub(r"<(style|script)>.*?</\1>|<[^>]*>", " ", html, flags=re.DOTALL)
    return " ".join(told.split())


FACTS = BASELINE / "quoted/sections.json"
"""What all sections say of the accepted results, written by

    PYTHONPATH=scripts python tests/accepted.py
"""

if __name__ == "__main__":
    told = {name: facts(name, Report()) for name in sections()}
    FACTS.write_text(json.dumps(told, indent=0, ensure_ascii=False) + "\n", encoding="utf-8")
