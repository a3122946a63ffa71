"""The configuration that the claims are about, and differences of a user's configuration from it.

Users may edit every case. Claims about the paper's figures are then not applicable. The file
paper.json in this folder holds the cases, the sweeps and the studies' choices as this project reads
the paper. Editing config/*.yaml does not change it; `python docs/keep.py config` renews it, and a
test fails if the committed files differ.
"""

import json
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from replication.differences import Differences, Tolerated, find_differences

FILE = Path(__file__).with_suffix(".json")

TOLERATED = Tolerated(
    free=frozenset({"seed", "draw", "snapshot_step", "long", "points"}),
    at_least=frozenset({"members", "nodes"}),
    at_most=frozenset({"tolerance"}),
    single=frozenset({"initial"}),
)
"""Keys whose changes affect no claim: seeds, windows in figures, longer studies, and larger
ensembles, finer grids or smaller tolerances."""

DATA = ("model", "epsilon", "gamma", "omega", "initial")
"""Keys of a case that determine a solution on an infinite chain."""


@cache
def paper() -> dict[str, Any]:
    """Return the paper's configuration as plain values."""
    return json.loads(FILE.read_text(encoding="utf-8"))


def differences(configuration: Mapping[str, Any]) -> dict[str, str]:
    """Return the differences from the paper's configuration by key; added cases do not count."""
    differences = find_differences(paper(), configuration, TOLERATED)
    return {".".join(place): _difference_text(place, *pair) for place, pair in differences.items()}


def _difference_text(place: tuple, was: Any, now: Any) -> str:
    keys = place[1:] if place[0] in ("cases", "sweeps") else place
    short, of_paper = _short(now), _short(was)
    value = str(now) if short == of_paper else short  # print all digits if both look the same
    return f"{'.'.join(keys)} ({value} in place of {of_paper})"


def _short(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:g}"
    if value is None:
        return "none"
    if isinstance(value, Mapping) and "name" in value:
        return str(value["name"])
    if isinstance(value, Mapping):
        sites = (f"{site}: {_short(pair)}" for site, pair in value.items())
        return f"{{{', '.join(sites)}}}"
    if isinstance(value, list):
        text = f"[{', '.join(map(_short, value))}]"
        return text if len(text) <= 50 else f"{len(value)} values from {_short(value[0])}"
    return "0" if str(value) == "0j" else str(value).removesuffix("+0j")


def constants_differ(differs: Mapping[str, str], cases: Iterable[str]) -> bool:
    """Return whether the constants of (4) differ from the paper's in one of `cases`."""
    constants = ("epsilon", "gamma", "omega")
    return any(f"cases.{case}.{key}" in differs for case in cases for key in constants)


# --- Dependencies of datasets ---------------------------------------------------------------------

ALL_CASES = ("cases", "lyapunov", "members", "solvers", "trust", "remainder")
"""Datasets of all cases of the paper."""


@cache
def rests_on(name: str, on: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return the keys of the configuration that a dataset depends on, as dotted paths.

    A dataset depends on all keys of a case that is integrated on a finite chain. Of the cases and
    sweeps in a dataset, only those in `on` count, or all if `on` is empty.
    """
    folder, _, name_in_folder = name.partition("/")
    stem, _, solver = name_in_folder.partition(".")
    by = (f"solvers.{solver}",) if solver else ()
    if folder == "sweeps":
        return (*_swept([stem]), *by)
    if stem in paper()["cases"]:
        of_case = _unbounded([stem]) if folder == "unbounded" else (f"cases.{stem}",)
        return (*of_case, *by)
    if folder == "unbounded":
        ensemble = paper()["unbounded"]["starts" if stem == "starts" else "omegas"]
        return _unbounded([ensemble["case"]])
    sections = _sections(folder, stem)
    section = _at(sections[-1]) if sections else {}
    named = paper()["cases"] if stem in ALL_CASES else section.get("cases", ())
    cases = (
        [section["case"]] if "case" in section else [case for case in named if not on or case in on]
    )
    swept = [section["sweep"]] if "sweep" in section else section.get("sweeps", ())
    sweeps = [sweep for sweep in swept if not on or sweep in on]
    return (*sections, *_swept(sweeps), *(f"cases.{case}" for case in cases))


def _swept(sweeps: Iterable[str]) -> tuple[str, ...]:
    """Return the keys that the paper's sweeps depend on; a user's sweeps are left out."""
    known = [sweep for sweep in sweeps if sweep in paper()["sweeps"]]
    cases = [paper()["sweeps"][sweep]["case"] for sweep in known]
    return (*(f"sweeps.{sweep}" for sweep in known), *(f"cases.{case}" for case in cases))


def _unbounded(cases: Iterable[str]) -> tuple[str, ...]:
    return ("unbounded", *(f"cases.{case}.{key}" for case in cases for key in DATA))


def _sections(folder: str, stem: str) -> list[str]:
    """Return the sections that a dataset of a study depends on. The study's own is the last."""
    if stem in ("solvers", "trust"):
        return ["solvers"]
    if stem == "second_solver":
        return ["solvers.crank_nicolson", "chaos.ensembles", "chaos.second_solver"]
    if folder == "checks":
        return [f"chaos.{stem}"] if _at(f"chaos.{stem}") else []  # checks of the theory have none
    if folder == "breathers":
        return [f"breathers.{key}" for key in ("epsilon", "gamma", stem)]
    if folder == "pendula":
        return [f"newton.{stem}"]
    return [f"{folder}.{stem}"]


def _at(path: str) -> Any:
    """Return the value at a dotted path of the paper's configuration, or {} if there is none."""
    value = paper()
    for key in path.split("."):
        value = value.get(key, {})
    return value


def from_paper(words: Mapping[str, str]) -> Differences:
    """Return `Differences` from the paper with these descriptions and with `rests_on`."""
    return Differences(words, rests_on)


def concerning(
    differs: Mapping[str, str], names: Iterable[str], on: Iterable[str] = ()
) -> dict[str, str]:
    """Return the differences that affect the datasets called `names`."""
    return from_paper(differs).concerning(names, on)


def reason(differs: Mapping[str, str], names: Iterable[str], on: Iterable[str] = ()) -> str:
    """Return why datasets are not of the paper's cases, or an empty text if they are."""
    return from_paper(differs).reason(names, on)
