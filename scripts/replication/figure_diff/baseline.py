"""The accepted results in tests/baseline, and the comparison of a run with them.

A file with the accepted hash is identical. Any other hash is an error in the environment that made
the baseline: there the same code gives the same bits, on all processors of one family. In other
environments, or with bits=any, the file is compared with the stored copy.
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

from . import (
    ComparisonResult,
    FileResult,
    Status,
    compare_datasets,
    compare_pictures,
    compare_shown,
    hashes,
)
from .chaos import Trust, known_chaos
from .scatter import known_scatter

RECORD = "hashes.json"
"""The environment and the configuration of the baseline, and the hashes of its files."""

FILE_NAMES = re.compile(r"(?:[a-z_]+/)*(?!hashes\.json)[\w.]*\w\.(?:nc|json|md|html|yaml|png|pdf)")
"""Pattern of the files of a run: paths below the folder of the results."""

FIGURES, PICTURES = "figures/", (".png", ".pdf")
"""The folder of figures, each with a dataset, two pictures and a description."""


@cache
def environment() -> dict[str, dict[str, str]]:
    """Return the versions and the processor family that determine the bits of data and drawings."""
    zlibs = f"{zlib.ZLIB_RUNTIME_VERSION}, {features.version('zlib')}"
    drawing = {"freetype": ft2font.__freetype_version__, "zlib": zlibs}
    packages = {name: version(name) for name in ("numpy", "scipy", "numba", "llvmlite")}
    drawing |= {name: version(name) for name in ("matplotlib", "pillow")}
    return {"data": packages | {"machine": platform.machine()}, "drawing": drawing}


def recorded(folder: Path) -> dict[str, Any]:
    """Return the record of a baseline, empty if there is none.

    Raises DatasetError if the record is damaged, or lists a file outside `folder` or a file that
    no run makes. Listed files are read, and deleted once they are obsolete.
    """
    if not (folder / RECORD).exists():
        return {"environment": {}, "configuration": {}, "files": {}}
    record, resolved = load_json(folder / RECORD), folder.resolve()
    for name in record["files"]:
        inside = (resolved / name).resolve().parent == (resolved / name).parent
        if not (inside and FILE_NAMES.fullmatch(name)):
            raise DatasetError(f"{folder / RECORD} lists {name}, which no run makes")
    return record


def is_kept(name: str) -> bool:
    """Return whether the baseline stores a copy of a file; of PDFs and pages it has only hashes."""
    return not name.endswith((".pdf", ".html"))


def fault_of_kept(name: str, accepted: Mapping[str, Any], folder: Path) -> str:
    """Return what is wrong with a file's copy in the baseline, or an empty text."""
    if name not in accepted or not (folder / name).exists():
        return "is missing"
    record = accepted[name]
    known = record if isinstance(record, str) else record["kept"]
    same = hashes.of_bytes((folder / name).read_bytes()) == known
    return "" if same else "was edited since it was accepted"


def compare(
    names: Iterable[str],
    results: Path,
    folder: Path,
    configuration: Mapping[str, Any],
    trust: Trust | None = None,
    any_bits: bool = False,
) -> ComparisonResult:
    """Return the result for each file in `names` (paths below `results`) or in the baseline.

    `trust` names the dataset with the horizons of trust. With `any_bits`, numbers are compared
    within a tolerance even in the accepted environment.
    """
    try:
        record = recorded(folder)
    except DatasetError:
        way_out = "restore it with git, or delete it and run `snakemake accept_figures`"
        reason = f"the baseline's record is damaged or was edited: {way_out}"
        return ComparisonResult(
            "Nothing was compared.", [FileResult(RECORD, Status.DAMAGED, reason)]
        )
    comparison = Comparison(record, results, folder, trust)
    findings = [comparison.strictly(each, any_bits) for each in comparison.look_at_all(set(names))]
    unlike = " and ".join(unlike_settings(record["configuration"], configuration)[:2])
    if unlike and record["files"]:
        reason = f"is not the accepted one: {unlike}"
        findings.append(FileResult("configuration", Status.DIFFERENT, reason))
    order = list(Status)
    findings.sort(key=lambda each: (order.index(each.status), each.name))
    unlike_environment = "; ".join(unlike_settings(record["environment"], environment()))
    why = "bits=any was given" if any_bits else f"the environment differs: {unlike_environment}"
    judged = f"Numbers are compared within a tolerance up to the horizon of trust: {why}."
    if not (unlike_environment or any_bits):
        judged = "The environment is the accepted one, so every file must have the accepted bits."
    if not record["files"]:
        judged = "No run has been accepted as the baseline."
    return ComparisonResult(judged, findings)


class Comparison:
    """The comparison of a run with its baseline; it stores the results so far."""

    def __init__(
        self, record: Mapping, made: Path, folder: Path, trust: Trust | None = None
    ) -> None:
        self.accepted, self.made, self.folder = record["files"], made, folder
        was, now = record["environment"], environment()
        self.same_data, self.same_drawing = was.get("data") == now["data"], was == now
        if trust and fault_of_kept(trust.dataset, self.accepted, folder):
            trust = None
        self.steps = trust.steps if trust else ()
        self.chaos = known_chaos(folder, record["configuration"], trust)
        self.scatter = known_scatter(folder)
        self.found: dict[str, FileResult] = {}

    def look_at_all(self, names: set[str]) -> list[FileResult]:
        """Return the results; datasets are first, because texts and pictures depend on them."""
        for name in sorted(names | self.accepted.keys(), key=place):
            self.look_at(name, name in names)
        return list(self.found.values())

    def look_at(self, name: str, is_made: bool = True) -> FileResult:
        """Return the result for a file, and store it for the files that depend on it."""
        self.found[name] = FileResult(name, *self._judge(name, is_made))
        return self.found[name]

    def _judge(self, name: str, is_made: bool) -> tuple[Status, str]:
        if not is_made:
            return Status.MISSING, "is in the baseline, but no longer among the results"
        if not (self.made / name).exists():
            return Status.MISSING, "was not made"
        if name not in self.accepted:
            return Status.EXTRA, "is not in the baseline"
        if is_kept(name) and (fault := fault_of_kept(name, self.accepted, self.folder)):
            way_out = "restore it with git, or accept it again"
            return Status.DAMAGED, f"its copy in the baseline {fault}: {way_out}"
        return self._compare(name, self.made / name, self.folder / name, self.accepted[name])

    def _compare(
        self, name: str, new: Path, accepted_copy: Path, accepted: Any
    ) -> tuple[Status, str]:
        if name.endswith(".nc"):
            return compare_datasets.compare(
                name, new, accepted, accepted_copy, self.chaos, self.scatter, self.steps
            )
        new_hash = compare_shown.hash_of(name, new.read_bytes())
        same = new_hash == accepted
        if name.startswith(FIGURES) and name.endswith(PICTURES):
            return compare_pictures.compare_picture(
                new, accepted_copy, same, self._beside(name, ".json")
            )
        if name.startswith(FIGURES):
            data = self._beside(name, ".nc")
            return compare_shown.compare_description(accepted_copy, new, data, self.same_drawing)
        if same:
            return Status.IDENTICAL, ""
        if name.endswith(".pdf") and (fault := compare_pictures.damage(new, new.read_bytes())):
            return Status.DAMAGED, fault
        datasets = {n: result.status for n, result in self.found.items() if n.endswith(".nc")}
        if is_kept(name):
            return compare_shown.compare(new, accepted_copy.read_text("utf-8"), datasets)
        follows = Status.BEYOND in datasets.values()
        return self._without_content(name, new_hash.split(), accepted.split(), follows)

    def _without_content(
        self, name: str, new_hashes: list[str], accepted: list[str], follows_chaos: bool
    ) -> tuple[Status, str]:
        """Return the status of a file for which the baseline has only hashes (see `hash_of`)."""
        reason = "does not have the accepted hash; the baseline has no copy to compare"
        if len(new_hashes) == 1:  # a PDF
            may_be = follows_chaos or not self.same_drawing
        elif new_hashes[1:] == accepted[1:]:
            if not self.same_drawing:
                return Status.WITHIN, "has code or pictures of other package versions"
            may_be = follows_chaos and name != "live.html"  # no result affects its code
        else:
            may_be = follows_chaos and new_hashes[-1] == accepted[-1]
        return Status.BEYOND if may_be else Status.DIFFERENT, reason

    def _beside(self, name: str, kind: str) -> Status:
        """Return the status of the file with the same stem and the suffix `kind`."""
        result = self.found.get(Path(name).with_suffix(kind).as_posix())
        return result.status if result else Status.MISSING

    def strictly(self, result: FileResult, any_bits: bool) -> FileResult:
        """Return the result; it becomes a failure if the file must have the accepted bits."""
        if result.status not in (Status.WITHIN, Status.BEYOND):
            return result
        strict = self.same_data and not any_bits
        if result.name.endswith(PICTURES):
            drawn_alike = self._beside(result.name, ".json") == Status.IDENTICAL
            strict = self.same_drawing and (strict or drawn_alike)
        elif result.name.startswith(FIGURES) or result.name in compare_shown.OF_VERSIONS:
            is_dataset = result.name.endswith(".nc")
            strict = strict and (is_dataset or self.same_drawing)
        reason = f"not bit-identical, but {result.status}: {result.reason}"
        return result._replace(status=Status.DIFFERENT, reason=reason) if strict else result


def place(name: str) -> tuple[bool, ...]:
    """Return the sorting key of a file: each file comes after the files that it depends on."""
    return name.endswith(PICTURES), not name.endswith(".nc"), name.startswith(FIGURES)


def unlike_settings(was: Any, now: Any, place: str = "") -> list[str]:
    """Return a phrase with the dotted path for each difference of two mappings."""
    if isinstance(was, Mapping) and isinstance(now, Mapping):
        differences = []
        for key in dict.fromkeys([*was, *now]):
            inner = f"{place}.{key}".lstrip(".")
            differences += unlike_settings(was.get(key, "absent"), now.get(key, "absent"), inner)
        return differences
    short = [text if len(text) < 60 else text[:57] + "..." for text in map(str, (now, was))]
    return [] if was == now else [f"{place} is {short[0]} in place of {short[1]}"]
