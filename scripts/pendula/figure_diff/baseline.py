"""The accepted results in tests/baseline: what they hold, and how a run is compared with them.

The baseline holds a hash of every file of a full run, and of every variable of its datasets. A file
with the accepted hash is the same; only a picture must also belong to its data. Of any other file
the baseline keeps what shows where and by how much it differs: datasets at every sample in single
precision, pictures, the ledger and tables.

Each file is judged by the allowances first: a file with other bits is "nearly the same" if another
right run could have made it. In the environment that made the baseline this excuses nothing,
because the same code gives the same bits on every processor of a family. So there such a file is a
fault too, which says that it agrees within the allowances.
"""

import json
import platform
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from matplotlib import ft2font

from . import (
    DAMAGED,
    DIFFERENT,
    EXTRA,
    IDENTICAL,
    MISSING,
    NEARLY,
    STATUSES,
    Finding,
    Motion,
    Verdict,
    compare_dataset,
    compare_description,
    compare_images,
    compare_pdf,
    compare_words,
    hashes,
)
from .tolerances import SPREADS, TOLERANCES, read_tolerances

RECORD, HASHES = "accepted.json", "hashes.json"
"""What the baseline is of, with the hash of each file in its folder; and the hashes of the run."""

ALLOWANCES = {
    TOLERANCES: "which curves may move",
    SPREADS: "how far curves may move",
}
"""The files of the baseline that no run makes, and what they say."""

FIGURES = "figures/"
"""The folder where each dataset has two pictures and a description of them beside it."""

PICTURES = (".png", ".pdf")
"""Files whose bytes depend on the environment."""

DECIDE_BITS = ("numpy", "scipy", "numba", "llvmlite", "matplotlib", "pillow")
"""Packages whose versions decide bits of data, or pixels."""


@cache
def _versions() -> dict[str, str]:
    return {name: version(name) for name in DECIDE_BITS}


def environment() -> dict[str, str]:
    """Return what decides bits: versions, and the family of the processor."""
    return _versions() | {
        "freetype": ft2font.__freetype_version__,
        "machine": platform.machine(),
    }


def recorded(folder: Path) -> dict[str, Any]:
    """Return the record: environment, configuration, files of the run, and hashes of what is kept.

    Without a baseline, all are empty.
    """
    empty = {"environment": {}, "configuration": {}, "files": [], "kept": {}}
    try:
        return empty | json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except FileNotFoundError:
        return empty


def accepted_hashes(folder: Path) -> dict[str, Any]:
    """Return the hashes by file: a text, or those of a dataset; without a baseline, none."""
    try:
        return json.loads((folder / HASHES).read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}


def is_kept(name: str) -> bool:
    """Return whether the baseline keeps the content of a file beside its hash.

    References are committed already, and no other bits of them are right. A PDF shows what the PNG
    shows.
    """
    return not name.startswith("truth/") and not name.endswith(".pdf")


def hashes_of_kept(folder: Path, files: Iterable[str]) -> dict[str, str]:
    """Return the hash of each file in the folder that must stay as it was accepted.

    `files` are those of the run.
    """
    names = sorted({HASHES, *ALLOWANCES, *filter(is_kept, files)})
    paths = {name: folder / name for name in names}
    return {n: hashes.of_bytes(path.read_bytes()) for n, path in paths.items() if path.exists()}


def compare(
    names: Iterable[str],
    made: Path,
    folder: Path,
    configuration: Mapping[str, Any],
    any_bits: bool = False,
) -> Verdict:
    """Return a finding for each file of `names` below `made` or in the baseline alone.

    With `any_bits`, and in an environment that is not the accepted one, the allowances decide.
    """
    record, names = recorded(folder), set(names)
    unlike = unlike_settings(record["environment"], environment())
    edited = {each.name: each for each in _edited(record, folder)}
    comparison = _Comparison(made, folder, same_environment=not unlike)
    found: dict[str, Finding] = {}
    # Datasets come first: what else was made of them is judged by whether they have moved.
    for name in sorted({*names, *record["files"]}, key=lambda each: not each.endswith(".nc")):
        found[name] = (
            edited.get(name) or _absent(name, names, comparison) or comparison.compare(name, found)
        )
    findings = [*found.values(), *(edited[name] for name in edited.keys() - found.keys())]
    if not unlike and not any_bits:
        findings = [_as_fault(each) for each in findings]
    findings += _of_another_configuration(record, configuration)
    order = sorted(findings, key=lambda each: (STATUSES.index(each.status), each.agrees, each.name))
    return Verdict(_judged(record, unlike, any_bits), order)


def _judged(record: Mapping[str, Any], unlike: list[str], any_bits: bool) -> str:
    """Return in words by which measure a run is judged."""
    if not record["files"]:
        return "No run has been accepted as the baseline."
    by = "Files with other bits are judged by what right runs may differ"
    if unlike:
        return f"{by}, because the environment is not the accepted one: {'; '.join(unlike)}."
    if any_bits:
        return f"{by}, because bits=any asks for it."
    return "The environment is the accepted one, so every file must have the accepted bits."


def _as_fault(found: Finding) -> Finding:
    """Return the finding where the accepted bits are the only right ones."""
    if found.status != NEARLY:
        return found
    says = f"{found.says}; this agrees within the allowances"
    return replace(found, status=DIFFERENT, says=says, agrees=True)


def _edited(record: Mapping[str, Any], folder: Path) -> Iterator[Finding]:
    """Yield a fault for each file of the baseline that is not as it was accepted."""
    now = hashes_of_kept(folder, record["files"])
    for name in sorted({*record["kept"], *now}):
        if record["files"] and record["kept"].get(name) != now.get(name):
            how = "is missing" if name not in now else "was edited since it was accepted"
            if name in ALLOWANCES:
                says = (
                    f"says {ALLOWANCES[name]}, and {how}: look at what it allows, and accept it by "
                    f"`snakemake accept_figures --config accept={name}`"
                )
                yield Finding(name, DIFFERENT, says)
            else:
                says = f"in the baseline {how}: restore it, or accept the results again"
                yield Finding(name, DAMAGED, says)


def _of_another_configuration(
    record: Mapping[str, Any], configuration: Mapping[str, Any]
) -> Iterator[Finding]:
    if record["files"] and record["configuration"] != configuration:
        says = " and ".join(unlike_settings(record["configuration"], configuration)[:2])
        yield Finding("configuration", DIFFERENT, f"is not the accepted one: {says}")


def unlike_settings(was: Any, now: Any, place: str = "") -> list[str]:
    """Return in words how two configurations differ, each entry by its dotted path."""
    if isinstance(was, Mapping) and isinstance(now, Mapping):
        said = []
        for key in dict.fromkeys([*was, *now]):
            inner = f"{place}.{key}".lstrip(".")
            said += unlike_settings(was.get(key, "absent"), now.get(key, "absent"), inner)
        return said
    short = [text if len(text) < 60 else text[:57] + "..." for text in map(str, (now, was))]
    return [] if was == now else [f"{place} is {short[0]} in place of {short[1]}"]


class _Comparison:
    """A run beside its baseline; each of their files is read once."""

    def __init__(self, made: Path, folder: Path, same_environment: bool):
        self.made, self.folder, self.same_environment = made, folder, same_environment
        self.hashes, self.tolerances = accepted_hashes(folder), read_tolerances(folder)

    def compare(self, name: str, found: Mapping[str, Finding]) -> Finding:
        """Return the finding for a file that both have; `found` holds those of all datasets."""
        if name.endswith(".nc"):
            folder = self.folder if is_kept(name) else None
            return compare_dataset.compare(
                name, self.made, folder, self.hashes[name], self.tolerances
            )
        if name.startswith(FIGURES) or name.endswith(PICTURES):
            return self._compare_figure(name, found.get(str(Path(name).with_suffix(".nc"))))
        content = (self.made / name).read_bytes()
        if hashes.of_bytes(content) == self.hashes[name]:
            return Finding(name, IDENTICAL)
        accepted = (self.folder / name).read_text(encoding="utf-8")
        datasets = {each.name: each.motion for each in found.values() if each.name.endswith(".nc")}
        made = content.decode("utf-8", errors="replace")
        return compare_words.compare(name, accepted, made, datasets)

    def _compare_figure(self, name: str, data: Finding | None) -> Finding:
        """Return the finding for a picture or a description; `data` is that of what it shows.

        Even one with the accepted bytes must belong to the data beside it, which may be others.
        """
        accepted, new = self.folder / name, self.made / name
        described = accepted.with_suffix(".json"), new.with_suffix(".json")
        motion = data.motion if data else Motion.WRONG
        if motion is Motion.UNSEEN and compare_description.shows_rounding(described[0]):
            motion = Motion.SEEN
        if name.endswith(".json"):
            return compare_description.compare(name, accepted, new, new.with_suffix(".nc"), motion)
        if name.endswith(".pdf"):
            known = self.hashes[name]
            return compare_pdf.compare(name, known, new, described, self.same_environment)
        method = compare_images.method(motion, self.same_environment)
        return compare_images.compare(name, accepted, new, described[1], method)


def _absent(name: str, names: set[str], comparison: _Comparison) -> Finding | None:
    """Return the finding for a file that cannot be compared because one of the two is absent."""
    if name not in names:
        return Finding(name, MISSING, "is in the baseline, but no longer among the results")
    if not (comparison.made / name).exists():
        return Finding(name, MISSING, "was not made")
    if name not in comparison.hashes:
        return Finding(name, EXTRA, "is not in the baseline")
    return None
