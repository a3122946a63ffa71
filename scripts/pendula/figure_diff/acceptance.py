"""Takes a run, or some of its files, as the new baseline, and says before what that changes."""

import difflib
import json
from collections import Counter
from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, NamedTuple

from pendula.datasets import complete_or_absent
from pendula.datasets.netcdf import DatasetError

from . import compare_pdf, compare_words, hashes
from .baseline import (
    ALLOWANCES,
    HASHES,
    RECORD,
    accepted_hashes,
    environment,
    hashes_of_kept,
    is_kept,
    recorded,
    unlike_settings,
)
from .doubts import doubts
from .hashes import Content

NEW, CHANGED, REMOVED = "new", "changed", "removed"


class AcceptanceError(ValueError):
    """Nothing was accepted; the message says why, and what to do."""


class Acceptance(NamedTuple):
    """What accepting is about to do; nothing has been changed yet."""

    changes: dict[str, str]
    """NEW, CHANGED or REMOVED by the names of files."""
    taken: set[str]
    """The files that were looked at; all others stay as they were accepted."""
    record: dict[str, Any]
    hashes: dict[str, Any]
    contents: dict[str, Content]
    """What the datasets hold, read once: what was judged is what is kept."""
    lines: list[str]
    """All this in words."""


def check(
    configuration: Mapping[str, Any], committed: Mapping[str, Any], folder: Path, some: bool
) -> None:
    """Raise AcceptanceError unless a run of this configuration may go into the baseline `folder`.

    `committed` is what config/*.yaml say alone. A folder without a record takes any run, and a run
    may renew a baseline of its own configuration. A run of the committed one may also replace that
    of another, but never `some` files of it: all files must be of one configuration.
    """
    if not (folder / RECORD).exists():
        return
    accepted = recorded(folder)["configuration"]
    if configuration == accepted or (configuration == committed and not some):
        return
    known = accepted if configuration == committed else committed
    said = unlike_settings(known, configuration)
    more = f" (and {len(said) - 3} more)" if len(said) > 3 else ""
    whose = "the accepted files" if known is accepted else "config/*.yaml"
    way_out = (
        "accept all files, since those that stay would be of another configuration"
        if known is accepted
        else "run it without --configfile and --config; for a baseline of another configuration "
        "give a folder, as in `--config baseline=my_baseline`"
    )
    raise AcceptanceError(
        f"nothing is accepted: this run is not of the configuration of {whose}: "
        f"{'; '.join(said[:3])}{more}. What to do: {way_out}"
    )


def choose(words: Iterable[str], names: Iterable[str]) -> list[str]:
    """Return the files that the words name: `fig3`, `checks/worst`, `tables/claims.md`, `truth/*`.

    A word is the path of a file below results/, with or without its ending, or the name of a
    figure; * stands for any letters. Raises AcceptanceError for a word that names nothing.
    """
    names, chosen = sorted(names), set()
    for word in words:
        found = [name for name in names if _fits(name, word)]
        if not found:
            known = {form: name for name in names for form in (name, _stem(name), Path(name).stem)}
            near = difflib.get_close_matches(word, known, 1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise AcceptanceError(f"nothing is accepted: {word} names no file of a full run{hint}")
        chosen.update(found)
    return sorted(chosen)


def _fits(name: str, word: str) -> bool:
    stem = _stem(name)
    return any(
        fnmatchcase(*pair) for pair in ((name, word), (stem, word), (stem, f"figures/{word}"))
    )


def _stem(name: str) -> str:
    return name.rpartition(".")[0]


def plan(
    names: Iterable[str],
    made: Path,
    folder: Path,
    configuration: Mapping[str, Any],
    chosen: Iterable[str] | None = None,
) -> Acceptance:
    """Return what accepting the run `made` would do: all its files `names`, or those in `chosen`.

    Files of the baseline that are not among `names` are removed if they are chosen. Raises
    AcceptanceError if a file is empty, damaged or doubtful, or if two environments would mix.
    """
    names, record, known = set(names), recorded(folder), accepted_hashes(folder)
    every = names | {*record["files"], *ALLOWANCES}
    looked_at = every if chosen is None else set(chosen)
    taken = looked_at - ALLOWANCES.keys()
    here = environment()
    if looked_at != every and taken and record["environment"] not in ({}, here):
        raise AcceptanceError(
            "nothing is accepted: the other files of the baseline were made in another environment "
            f"({'; '.join(unlike_settings(record['environment'], here))}); accept all files, or "
            "use the pinned environment"
        )
    present = sorted(taken & names)
    contents = {name: _content(made / name) for name in present if name.endswith(".nc")}
    fresh = {name: _hashes_of(made / name, contents.get(name)) for name in present}
    changes = {
        name: CHANGED if name in known else NEW
        for name in present
        if known.get(name) != fresh[name]
        or (is_kept(name) and not _is_whole(made / name, folder / name, contents.get(name)))
    }
    changes |= dict.fromkeys(sorted(taken - names), REMOVED)
    changes |= _changes_of_allowances(looked_at, record, folder)
    _refuse_doubtful(changes, contents, folder, configuration, named=chosen is not None)
    files = sorted({*record["files"], *fresh} - (taken - names))
    record |= {"configuration": dict(configuration), "files": files}
    if taken:
        record["environment"] = here
    lines = _say(changes, len(files), made, folder)
    accepted = {name: each for name in files if (each := fresh.get(name, known.get(name)))}
    return Acceptance(changes, looked_at, record, accepted, contents, lines)


def _changes_of_allowances(
    looked_at: set[str], record: Mapping[str, Any], folder: Path
) -> dict[str, str]:
    """Return which files of allowances are not as they were accepted."""
    was, now = record["kept"], hashes_of_kept(folder, [])
    found = {}
    for name in ALLOWANCES.keys() & looked_at:
        if was.get(name) != now.get(name):
            found[name] = REMOVED if name not in now else CHANGED if name in was else NEW
    return found


def _refuse_doubtful(
    changes: Mapping[str, str],
    contents: Mapping[str, Content],
    folder: Path,
    configuration: Mapping[str, Any],
    named: bool,
) -> None:
    """Raise AcceptanceError if a new dataset contradicts its name, or lost numbers."""
    said = []
    for name, content in contents.items():
        if kind := changes.get(name):
            known = None if named or kind == NEW or not is_kept(name) else folder / name
            said += [f"{name}: {each}" for each in doubts(name, content, known, configuration)]
    if said:
        more = f" (and {len(said) - 3} more)" if len(said) > 3 else ""
        raise AcceptanceError(f"nothing is accepted: {'; '.join(said[:3])}{more}")


def _content(path: Path) -> Content:
    try:
        return hashes.read(path)
    except DatasetError as error:
        raise AcceptanceError(f"nothing is accepted: {error}") from error


def _hashes_of(path: Path, dataset: Content | None) -> Any:
    if dataset:
        return hashes.of(dataset)
    if path.suffix == ".pdf":
        try:
            return compare_pdf.read(path).content
        except compare_pdf.DamagedPDFError as error:
            raise AcceptanceError(f"nothing is accepted: {path} {error}") from error
    content = path.read_bytes()
    if not content:
        raise AcceptanceError(f"nothing is accepted: {path} is empty")
    return hashes.of_bytes(content)


def _is_whole(new: Path, kept: Path, dataset: Content | None) -> bool:
    """Return whether the baseline holds the content that it would keep of a file."""
    if dataset is None:
        return kept.exists() and kept.read_bytes() == new.read_bytes()
    try:
        return hashes.of(hashes.read(kept)) == hashes.of(hashes.as_kept(dataset))
    except DatasetError:
        return False


def _say(changes: Mapping[str, str], files: int, made: Path, folder: Path) -> list[str]:
    """Return a line for each change, those of verdicts, and the counts."""
    lines = [f"{kind}: {name}" for name, kind in changes.items()]
    if changes.get("claims.json") == CHANGED and (folder / "claims.json").exists():
        texts = [(place / "claims.json").read_text(encoding="utf-8") for place in (folder, made)]
        was, now = map(compare_words.verdicts, texts)
        for claim in sorted({*was, *now}):
            if was.get(claim) != now.get(claim):
                pair = now.get(claim, "absent"), was.get(claim, "absent")
                lines.append(f"verdict: {claim} is {pair[0]} in place of {pair[1]}")
    counts = Counter(changes.values())
    told = ", ".join(f"{counts[kind]} {kind}" for kind in (NEW, CHANGED, REMOVED))
    return [*lines, f"{told}; the baseline then has {files} files"]


def take(acceptance: Acceptance, made: Path, folder: Path) -> None:
    """Change the baseline as planned; a file that is as it was is not written."""
    for name, kind in acceptance.changes.items():
        if name in ALLOWANCES:
            continue
        if kind == REMOVED:
            (folder / name).unlink(missing_ok=True)
        elif is_kept(name):
            _take(made / name, folder / name, acceptance.contents.get(name))
    _write(folder / HASHES, hashes.in_lines(acceptance.hashes))
    was, now = acceptance.record["kept"], hashes_of_kept(folder, acceptance.record["files"])
    stay = {name: was[name] for name in was if name not in acceptance.taken and name in now}
    kept = {**now, **stay, HASHES: now[HASHES]}
    _write(folder / RECORD, json.dumps(acceptance.record | {"kept": kept}, indent=1))


def _take(new: Path, kept: Path, dataset: Content | None) -> None:
    if dataset:
        return hashes.keep(kept, hashes.as_kept(dataset))
    with complete_or_absent(kept) as partial:
        partial.write_bytes(new.read_bytes())


def _write(path: Path, text: str) -> None:
    with complete_or_absent(path) as partial:
        partial.write_text(text + "\n", encoding="utf-8")
