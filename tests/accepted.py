"""The accepted results as the data of tests: datasets by name, and wrong changes of them."""

import math
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

import numpy as np
import xarray as xr
import yaml
from latticode.datasets.netcdf import read
from replication.ledger.changes import exchange, keep, put, scale, shift

ROOT = Path(__file__).parents[1]
BASELINE = ROOT / "tests/baseline"


@cache
def dataset(name: str) -> xr.Dataset:
    """Return an accepted dataset such as "checks/lyapunov"; tests must not change it in place."""
    return read(BASELINE / f"{name}.nc")


def datasets(names: Iterable[str]) -> dict[str, xr.Dataset]:
    """Return accepted datasets by their names."""
    return {name: dataset(name) for name in names}


def wrong_changes(kind: str) -> list[dict]:
    """Return the rows of one part of wrong_changes.yaml; the file describes its format."""
    return yaml.safe_load((Path(__file__).parent / "wrong_changes.yaml").read_text())[kind]


def changed(row: Mapping) -> dict[str, xr.Dataset]:
    """Return the datasets that a row of wrong_changes.yaml names, with its change."""
    sources = row.get("in", ())
    names = [sources] if isinstance(sources, str) else sources
    return {name: _change(dataset(row.get("take", name)), row) for name in names}


def _change(data: xr.Dataset, row: Mapping) -> xr.Dataset:
    if "keep" in row:
        data = keep(**_labels(row["keep"]))(data)
    if "exchange" in row:
        data = exchange(row["exchange"])(data)
    for verb, (key, change) in VERBS.items():
        names = [row[verb]] if isinstance(row.get(verb), str) else row.get(verb, ())
        if present := tuple(name for name in names if name in data):
            data = change(present, row[key], **_labels(row.get("at", {})))(data)
    return data


VERBS = {"scale": ("by", scale), "shift": ("by", shift), "set": ("to", put)}


def _labels(at: Mapping) -> dict:
    """Return labels by coordinate; a span {from, to} becomes a slice."""
    return {
        along: slice(label.get("from"), label.get("to")) if isinstance(label, dict) else label
        for along, label in at.items()
    }


def leaves(tree, place: str = "") -> dict:
    """Return the leaves of nested lists and dictionaries, by dotted path."""
    if not isinstance(tree, dict | list):
        return {place: tree}
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    return {at: leaf for key, node in items for at, leaf in leaves(node, f"{place}.{key}").items()}


def differing(left, right, share: float, amount: float = 0.0) -> dict[str, tuple]:
    """Return leaves that differ; numbers may differ by a relative `share` or by an `amount`."""
    left, right = leaves(left), leaves(right)
    pairs = {place: (left.get(place), right.get(place)) for place in left | right}

    def agree(a, b) -> bool:
        if {type(a), type(b)} <= {float, int, np.float64}:
            return math.isclose(a, b, rel_tol=share, abs_tol=amount)
        return a == b

    return {place: pair for place, pair in pairs.items() if not agree(*pair)}


def check_words(row: dict, right: str, wrong: str) -> None:
    """Check that only the wrong text has the words "told", and only the right one "untold"."""
    assert row.keys() & {"told", "untold"}
    for words, text, other_text in (
        (row.get("told"), wrong, right),
        (row.get("untold"), right, wrong),
    ):
        if words:
            assert words in text
            assert words not in other_text
