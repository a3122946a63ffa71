"""The accepted results in tests/baseline: what they hold, and how a run is compared with them.

A file with the accepted hash is identical. In the environment that made the baseline any other is a
fault, because the same code gives the same bits on every processor of a family. Elsewhere, or where
any bits are asked for, it is compared with what the baseline keeps.
"""

import platform
import re
import zlib
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from latticode.datasets.json_files import load_json
from latticode.datasets.netcdf import DatasetError
from matplotlib import ft2font
from PIL import features

from . import Finding, Status, Verdict, compare_datasets, compare_pictures, compare_shown, hashes
from .chaos import Trust, known_chaos
from .scatter import known_scatter

RECORD = "hashes.json"
"""The environment and the configuration of the baseline, and the hashes of its files."""

MADE = re.compile(r"(?:[a-z_]+/)*(?!hashes\.json)[\w.]*\w\.(?:nc|json|md|html|yaml|png|pdf)")
"""Names of the files of a run: below the folder of the results, in folders of words."""

FIGURES, PICTURES = "figures/", (".png", ".pdf")
"""The folder where each dataset has two pictures and a description of them beside it."""


@cache
def environment() -> dict[str, dict[str, str]]:
    """Return what decides the bits of data, and of drawings: versions, the family of processors."""
    zlibs = f"{zlib.ZLIB_RUNTIME_VERSION}, {features.version('zlib')}"
    drawing = {"freetype": ft2font.__freetype_version__, "zlib": zlibs}
    packages = {name: version(name) for name in ("numpy", "scipy", "numba", "llvmlite")}
    drawing |= {name: version(name) for name in ("matplotlib", "pillow")}
    return {"data": packages | {"machine": platform.machine()}, "drawing": drawing}


def recorded(folder: Path) -> dict[str, Any]:
    """Return the record of a baseline, empty if there is none.

    Raises DatasetError if it is damaged, or names what no run makes or what is not in `folder`: all
    that it names is read, and removed once it is no longer made.
    """
    if not (folder / RECORD).exists():
        return {"environment": {}, "configuration": {}, "files": {}}
    record, whole = load_json(folder / RECORD), folder.resolve()
    for name in record["files"]:
        inside = (whole / name).resolve().parent == (whole / name).parent
        if not (inside and MADE.fullmatch(name)):
            raise DatasetError(f"{folder / RECORD} names {name}, which no run makes")
    return record


def is_kept(name: str) -> bool:
    """Return whether the baseline keeps a file: no PDF and no report."""
    return not name.endswith((".pdf", ".html"))


def fault_of_kept(name: str, accepted: Mapping[str, Any], folder: Path) -> str:
    """Return the fault of the copy of a file in the baseline, or an empty text."""
    if name not in accepted or not (folder / name).exists():
        return "is missing"
    told = accepted[name]
    known = told if isinstance(told, str) else told["kept"]
    same = hashes.of_bytes((folder / name).read_bytes()) == known
    return "" if same else "was edited since it was accepted"


def compare(
    names: Iterable[str],
    made: Path,
    folder: Path,
    configuration: Mapping[str, Any],
    trust: Trust | None = None,
    any_bits: bool = False,
) -> Verdict:
    """Return a finding for each file of `names` below `made` or in the baseline alone.

    `trust` names the dataset that says until when chaotic cases are known. With `any_bits` numbers
    have a tolerance.
    """
    try:
        record = recorded(folder)
    except DatasetError:
        way_out = "restore it by git, or delete it and run `snakemake accept_figures`"
        says = f"in the baseline is damaged or was edited: {way_out}"
        return Verdict("Nothing was compared.", [Finding(RECORD, Status.DAMAGED, says)])
    comparison = Comparison(record, made, folder, trust)
    findings = [comparison.strictly(each, any_bits) for each in comparison.look_at_all(set(names))]
    unlike = " and ".join(unlike_settings(record["configuration"], configuration)[:2])
    if unlike and record["files"]:
        says = f"is not the accepted one: {unlike}"
        findings.append(Finding("configuration", Status.DIFFERENT, says))
    order = list(Status)
    findings.sort(key=lambda each: (order.index(each.status), each.name))
    other = "; ".join(unlike_settings(record["environment"], environment()))
    why = "bits=any was given" if any_bits else f"the environment differs: {other}"
    judged = f"Numbers are compared within a tolerance up to the horizon of trust: {why}."
    if not (other or any_bits):
        judged = "The environment is the accepted one, so every file must have the accepted bits."
    if not record["files"]:
        judged = "No run has been accepted as the baseline."
    return Verdict(judged, findings)


class Comparison:
    """A run beside its baseline, and what was found of each file."""

    def __init__(self, record: Mapping, made: Path, folder: Path, trust: Trust | None = None):
        self.accepted, self.made, self.folder = record["files"], made, folder
        was, now = record["environment"], environment()
        self.same_data, self.same_drawing = was.get("data") == now["data"], was == now
        if trust and fault_of_kept(trust.dataset, self.accepted, folder):
            trust = None
        self.steps = trust.steps if trust else ()
        self.chaos = known_chaos(folder, record["configuration"], trust)
        self.scatter = known_scatter(folder)
        self.found: dict[str, Finding] = {}

    def look_at_all(self, names: set[str]) -> list[Finding]:
        """Return the findings; datasets come first, since they decide about texts and pictures."""
        for name in sorted(names | self.accepted.keys(), key=place):
            self.look_at(name, name in names)
        return list(self.found.values())

    def look_at(self, name: str, is_made: bool = True) -> Finding:
        """Return the finding for one file, and keep it for those that follow."""
        self.found[name] = Finding(name, *self._judge(name, is_made))
        return self.found[name]

    def _judge(self, name: str, is_made: bool) -> tuple[Status, str]:
        if not is_made:
            return Status.MISSING, "is in the baseline, but no longer among the results"
        if not (self.made / name).exists():
            return Status.MISSING, "was not made"
        if name not in self.accepted:
            return Status.EXTRA, "is not in the baseline"
        if is_kept(name) and (fault := fault_of_kept(name, self.accepted, self.folder)):
            return Status.DAMAGED, f"in the baseline {fault}: restore it by git, or accept it again"
        return self._compare(name, self.made / name, self.folder / name, self.accepted[name])

    def _compare(self, name: str, new: Path, kept: Path, accepted: Any) -> tuple[Status, str]:
        if name.endswith(".nc"):
            return compare_datasets.compare(
                name, new, accepted, kept, self.chaos, self.scatter, self.steps
            )
        found = compare_shown.hash_of(name, new.read_bytes())
        same = found == accepted
        if name.startswith(FIGURES) and name.endswith(PICTURES):
            return compare_pictures.compare_picture(new, kept, same, self._beside(name, ".json"))
        if name.startswith(FIGURES):
            data = self._beside(name, ".nc")
            return compare_shown.compare_description(kept, new, data, self.same_drawing)
        if same:
            return Status.IDENTICAL, ""
        if name.endswith(".pdf") and (fault := compare_pictures.damage(new, new.read_bytes())):
            return Status.DAMAGED, fault
        datasets = {n: found.status for n, found in self.found.items() if n.endswith(".nc")}
        if is_kept(name):
            return compare_shown.compare(new, kept.read_text("utf-8"), datasets)
        follows = Status.BEYOND in datasets.values()
        return self._without_content(name, found.split(), accepted.split(), follows)

    def _without_content(
        self, name: str, found: list[str], accepted: list[str], follows_chaos: bool
    ) -> tuple[Status, str]:
        """Return the status of a file of which the baseline keeps hashes alone (`hash_of`)."""
        says = "is not the accepted one, of which the baseline keeps the hash alone"
        if len(found) == 1:  # a PDF
            may_be = follows_chaos or not self.same_drawing
        elif found[1:] == accepted[1:]:
            if not self.same_drawing:
                return Status.WITHIN, "holds code or pictures of other versions"
            may_be = follows_chaos and name != "live.html"  # code follows no number
        else:
            may_be = follows_chaos and found[-1] == accepted[-1]
        return Status.BEYOND if may_be else Status.DIFFERENT, says

    def _beside(self, name: str, kind: str) -> Status:
        """Return the status of the file of another kind beside this one."""
        found = self.found.get(Path(name).with_suffix(kind).as_posix())
        return found.status if found else Status.MISSING

    def strictly(self, found: Finding, any_bits: bool) -> Finding:
        """Return the finding as a fault where only the accepted bits are right."""
        if found.status not in (Status.WITHIN, Status.BEYOND):
            return found
        strict = self.same_data and not any_bits
        if found.name.endswith(PICTURES):
            drawn_alike = self._beside(found.name, ".json") == Status.IDENTICAL
            strict = self.same_drawing and (strict or drawn_alike)
        elif found.name.startswith(FIGURES) or found.name in compare_shown.OF_VERSIONS:
            is_dataset = found.name.endswith(".nc")
            strict = strict and (is_dataset or self.same_drawing)
        says = f"other bits, {found.status}: {found.says}"
        return found._replace(status=Status.DIFFERENT, says=says) if strict else found


def place(name: str) -> tuple[bool, ...]:
    """Return by what a file is sorted: each kind after those that it follows."""
    return name.endswith(PICTURES), not name.endswith(".nc"), name.startswith(FIGURES)


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
