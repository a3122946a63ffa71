"""The accepted results in tests/baseline: what they hold, and how a run is compared with them.

The baseline holds a hash of every file of a full run, and of every variable of its datasets. A file
with the accepted hash is the same; only a picture must also belong to its data. Of any other file
the baseline keeps what shows where and by how much it differs: datasets at every sample in single
precision, pictures, the ledger and tables.
"""

import json
import platform
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib import ft2font

from pendula.datasets.netcdf import DatasetError

from . import (
    DAMAGED,
    DIFFERENT,
    EXTRA,
    IDENTICAL,
    MISSING,
    NEARLY,
    STATUSES,
    Finding,
    compare_data,
    compare_description,
    compare_images,
    compare_pdf,
    compare_words,
    hashes,
)
from .tolerances import Tolerances, read_tolerances

RECORD, HASHES = "accepted.json", "hashes.json"
"""What names every file of the baseline, what drew it and its configuration; and the hashes."""

FIGURES = "figures/"
"""The folder where each dataset has two pictures and a description of them beside it."""

PICTURES = (".png", ".pdf")
"""Files whose bytes depend on the environment."""


def environment() -> dict[str, str]:
    """Return the versions on which the pixels of a figure depend."""
    return {
        "matplotlib": matplotlib.__version__,
        "numpy": np.__version__,
        "freetype": ft2font.__freetype_version__,
        "pillow": version("pillow"),
        "machine": platform.machine(),
    }


def recorded(folder: Path) -> dict[str, Any]:
    """Return the record: environment, configuration, files; without one, all are empty."""
    empty = {"environment": {}, "configuration": {}, "files": [], "hashes": ""}
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


def compare(
    names: Iterable[str], made: Path, folder: Path, configuration: Mapping[str, Any]
) -> list[Finding]:
    """Return a finding for each file of `names` below `made` or in the baseline alone."""
    record, names = recorded(folder), set(names)
    comparison = _Comparison(made, folder, record)
    found: dict[str, Finding] = {}
    # Datasets come first: what else was made of them is judged by whether they have moved.
    for name in sorted({*names, *record["files"]}, key=lambda each: not each.endswith(".nc")):
        found[name] = _absent(name, names, comparison) or comparison.compare(name, found)
    found |= {each.name: each for each in _of_the_whole(record, folder, configuration)}
    return sorted(found.values(), key=lambda each: (STATUSES.index(each.status), each.name))


def _of_the_whole(
    record: Mapping[str, Any], folder: Path, configuration: Mapping[str, Any]
) -> list[Finding]:
    """Return the faults that make the comparison of any file doubtful."""
    found = []
    if record["files"] and record["configuration"] != configuration:
        says = " and ".join(unlike_settings(record["configuration"], configuration)[:2])
        found.append(Finding("configuration", DIFFERENT, f"is not the accepted one: {says}"))
    if (folder / HASHES).exists() and record["hashes"] != hash_of_hashes(folder):
        says = "was edited since it was accepted: restore it, or accept the results again"
        found.append(Finding(HASHES, DAMAGED, says))
    return found


def hash_of_hashes(folder: Path) -> str:
    """Return the hash of the file of hashes, which the record holds."""
    return hashes.of_bytes((folder / HASHES).read_bytes())


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

    def __init__(self, made: Path, folder: Path, record: Mapping[str, Any]):
        self.made, self.folder = made, folder
        self.hashes, self.tolerances = accepted_hashes(folder), read_tolerances(folder)
        self.same_environment = record["environment"] == environment()

    def compare(self, name: str, found: Mapping[str, Finding]) -> Finding:
        """Return the finding for a file that both have; `found` holds those of all datasets."""
        if name.endswith(".nc"):
            accepted = self.hashes[name]
            return _compare_dataset(name, self.made, self.folder, accepted, self.tolerances)
        if name.startswith(FIGURES) or name.endswith(PICTURES):
            return self._compare_figure(name, found.get(str(Path(name).with_suffix(".nc"))))
        content = (self.made / name).read_bytes()
        if hashes.of_bytes(content) == self.hashes[name]:
            return Finding(name, IDENTICAL)
        accepted = (self.folder / name).read_text(encoding="utf-8")
        datasets = {each.name: each for each in found.values() if each.name.endswith(".nc")}
        made = content.decode("utf-8", errors="replace")
        return compare_words.compare(name, accepted, made, datasets)

    def _compare_figure(self, name: str, shown: Finding | None) -> Finding:
        """Return the finding for a picture or a description; `shown` is that of its data.

        Even one with the accepted bytes must belong to the data beside it, which may be others.
        """
        accepted, new = self.folder / name, self.made / name
        described = accepted.with_suffix(".json")
        moved = shown is not None and shown.status == NEARLY
        moved = moved and (shown.moved or compare_description.shows_rounding(described))
        if name.endswith(".json"):
            return compare_description.compare(name, accepted, new, new.with_suffix(".nc"), moved)
        beside = described, new.with_suffix(".json")
        if name.endswith(".pdf"):
            known = self.hashes[name]
            return compare_pdf.compare(name, known, new, beside, self.same_environment)
        same_data = shown is not None and shown.status == IDENTICAL
        exact = self.same_environment and same_data
        method = compare_images.EXACT if exact else compare_images.LOOK
        return compare_images.compare(name, accepted, new, method, moved, beside[1])


def _absent(name: str, names: set[str], comparison: _Comparison) -> Finding | None:
    """Return the finding for a file that cannot be compared because one of the two is absent."""
    if name not in names:
        return Finding(name, MISSING, "is in the baseline, but no longer among the results")
    if not (comparison.made / name).exists():
        return Finding(name, MISSING, "was not made")
    accepted = name in comparison.hashes
    if not accepted or (is_kept(name) and not (comparison.folder / name).exists()):
        return Finding(name, EXTRA, "is not in the baseline")
    return None


def _compare_dataset(
    name: str, made: Path, folder: Path, accepted: hashes.Hashes, tolerances: Tolerances
) -> Finding:
    """Return the finding by hashes, then by type and attributes, and by numbers last."""
    try:
        new = hashes.read(made / name)
    except DatasetError:
        return Finding(name, DAMAGED, "cannot be read")
    now = hashes.of(new)
    if now == accepted:
        return Finding(name, IDENTICAL)
    unlike = hashes.unlike_in_values(accepted, now)
    if not is_kept(name):
        says = ", ".join([*hashes.unlike_in_kind(accepted, now), *unlike]) or "attributes"
        return Finding(name, DIFFERENT, f"is not the accepted reference: other bits in {says}")
    try:
        known = hashes.read(folder / name)
    except DatasetError:
        return Finding(name, DAMAGED, "cannot be read in the baseline")
    faults = hashes.unlike_in_kind(accepted, now)
    if not hashes.same_attributes(accepted, now):
        faults += hashes.unlike_in_attributes(known, new, moved=bool(unlike))
    if faults:
        more = f" (and {len(faults) - 3} more)" if len(faults) > 3 else ""
        return Finding(name, DIFFERENT, "; ".join(faults[:3]) + more)
    if not unlike:
        return Finding(name, DIFFERENT, "has other hashes than were accepted, for no visible cause")
    pair = hashes.as_dataset(known), hashes.as_dataset(hashes.as_kept(new))
    found = compare_data.compare(name, *pair, tolerances, lambda other: _as_kept(made / other))
    return _without_the_bits(found, unlike)


def _as_kept(path: Path):
    return hashes.as_dataset(hashes.as_kept(hashes.read(path)))


def _without_the_bits(found: Finding, unlike: list[str]) -> Finding:
    """Return what the numbers say of datasets of one form with other bits: never `identical`."""
    if found.is_fault:
        return found
    others = f" and {len(unlike) - 3} more" if len(unlike) > 3 else ""
    bits = f"other bits in {', '.join(unlike[:3])}{others}"
    if found.status == IDENTICAL:
        says = f"{bits}, by less than single precision shows (6e-8)"
        return Finding(found.name, NEARLY, says)
    return Finding(found.name, NEARLY, f"{bits}: {found.says}", found.moved)
