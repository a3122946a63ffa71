"""Accepts a run, or some of its files, as the new baseline, which is under git."""

import difflib
from collections.abc import Iterable, Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import xarray as xr
from latticode.datasets import complete_or_absent
from latticode.datasets.json_files import load_json, write_json
from latticode.datasets.netcdf import DatasetError, read

from . import hashes
from .baseline import (
    FIGURES,
    PICTURES,
    RECORD,
    environment,
    fault_of_kept,
    is_kept,
    recorded,
    unlike_settings,
)
from .chaos import Chaos, cases_of
from .compare_datasets import fault_of_form, undeclared_words
from .compare_pictures import damage, edited
from .compare_shown import hash_of

ALL = "accept all files, because a baseline must be of one run"
WAY_OUT = (
    "run it without --configfile and --config; for a baseline of another configuration name its "
    "folder, as in `--config baseline=my_baseline`"
)


class AcceptanceError(ValueError):
    """Nothing was accepted; the message has the reason and what to do."""

    def __init__(self, why: object) -> None:
        super().__init__(f"nothing is accepted: {why}")


def check(now: Mapping, accepted: Mapping, owner: str, way_out: str) -> None:
    """Raise AcceptanceError unless the configuration or environment `now` equals the accepted one.

    `owner` and `way_out` are texts of the message.
    """
    if differences := unlike_settings(accepted, now):
        listed = "; ".join(
            [*differences[:3], *([f"and {len(differences) - 3} more"] if differences[3:] else [])]
        )
        raise AcceptanceError(f"this run does not match {owner}: {listed}. To fix this, {way_out}")


def choose(words: Sequence[str], names: Iterable[str]) -> list[str]:
    """Return the files that `words` select.

    A word is a path with or without suffix, or the name of a figure; `*` matches any characters.
    Raises AcceptanceError for a word that matches no file.
    """
    stems = {name: name.rpartition(".")[0] for name in sorted(names)}
    forms = {n: {n, stem, stem.removeprefix(FIGURES)} for n, stem in stems.items()}
    chosen = set()
    for word in words:
        named = {n for n in forms if any(fnmatchcase(form, word) for form in forms[n])}
        if not named:
            near = difflib.get_close_matches(word, sorted(set().union(*forms.values())), 1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise AcceptanceError(f"{word} names no file of a full run{hint}")
        chosen |= named
    return sorted(chosen)


def accept(
    names: Iterable[str],
    results: Path,
    folder: Path,
    configuration: Mapping[str, Any],
    words: Sequence[str] = (),
) -> str:
    """Copy the files `names` of a run into `folder`, and return a summary.

    If `words` are given, only the files that they select are copied. Accepted files that are not in
    `names` are removed. Raises AcceptanceError if a file is empty or damaged, or if the baseline
    would have files of two configurations or environments.
    """
    try:
        record, current, names = recorded(folder), environment(), set(names)
        was = record["files"]
        accepted = set(choose(words, names | was.keys())) if words else names | was.keys()
        if words and was:
            check(configuration, record["configuration"], "the accepted configuration", ALL)
            check(current, record["environment"], "the accepted environment", ALL)
        for name in accepted - names:
            if (folder / name).exists() and (fault := fault_of_kept(name, was, folder)):
                raise AcceptanceError(f"{folder / name}, which no run makes, {fault}: delete it")
        contents = {name: _read(name, results / name) for name in sorted(accepted & names)}
        _require_declarations(contents, configuration)
    except DatasetError as error:
        raise AcceptanceError(error) from error
    files = {name: content for name, content in was.items() if name not in accepted}
    files |= {n: _take(n, content, results / n, folder / n) for n, content in contents.items()}
    for name in accepted - names:
        (folder / name).unlink(missing_ok=True)
    content = {"environment": current, "configuration": configuration}
    write_json(folder / RECORD, content | {"files": dict(sorted(files.items()))})
    changed = sum(files[name] != was.get(name) for name in contents)
    removed = len(accepted - names)
    return (
        f"{len(contents)} files accepted, {changed} of them new or changed, {removed} "
        f"removed: `git diff --stat {folder}` shows what has changed"
    )


def _require_declarations(
    contents: Mapping[str, bytes | xr.Dataset], configuration: Mapping[str, Any]
) -> None:
    """Raise AcceptanceError if a variable does not declare whether it rests on chaos."""
    chaos = Chaos({}, cases=cases_of(configuration))
    for name, content in contents.items():
        if isinstance(content, xr.Dataset) and (unknown := chaos.undeclared(name, content)):
            raise AcceptanceError(f"in {name}, {undeclared_words(unknown)}")


def _read(name: str, path: Path) -> bytes | xr.Dataset:
    """Return the content of a file; raise DatasetError or AcceptanceError if it is damaged."""
    if name.endswith(".nc"):
        data = read(path)
        if fault := fault_of_form(path, data):
            raise AcceptanceError(f"{path} {fault}; delete it and run snakemake to make it again")
        return data
    if name.endswith(".json") and not name.startswith(FIGURES):
        load_json(path)
    content = path.read_bytes()
    fault = "" if content else "is empty"
    if name.endswith(PICTURES):
        fault = damage(path, content) or (name.startswith(FIGURES) and edited(path, content))
    if fault:
        raise AcceptanceError(f"{path} {fault}: delete it and run snakemake to make it again")
    return content


def _take(name: str, content: bytes | xr.Dataset, path: Path, copy: Path) -> str | dict[str, Any]:
    """Return the hashes of a file, and copy it if the baseline stores such files."""
    if isinstance(content, bytes):
        if is_kept(name):
            with complete_or_absent(copy) as partial:
                partial.write_bytes(content)
        return hash_of(name, content)
    if not is_kept(name):
        return hashes.of(content)
    hashes.keep(copy, path)
    return hashes.of(content) | {"kept": hashes.of_bytes(copy.read_bytes())}


def accept_results(
    results: list[str], words: list[str], baseline: str, configuration: dict, made: str
) -> None:
    """Accept the files of the run in the folder `made`, or those that `words` select."""
    names = [Path(path).relative_to(made).as_posix() for path in results]
    print(accept(names, Path(made), Path(baseline), configuration, words))
