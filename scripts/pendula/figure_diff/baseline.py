"""The accepted results in tests/baseline: what they hold, how a run is compared and accepted."""

import json
import platform
import shutil
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path

import matplotlib
import numpy as np
import xarray as xr
from matplotlib import ft2font

from pendula.datasets import complete_or_absent
from pendula.datasets.netcdf import DatasetError, read, save

from . import DAMAGED, EXTRA, MISSING, STATUSES, Finding, compare_data, compare_images
from .compare_data import Rule, read_rules

RECORD = "accepted.json"
"""The file that names every file of the baseline, and what drew it."""

MOST_NUMBERS = 10_000
"""A dataset of the baseline keeps at most so many numbers: 40 kB before compression."""


def environment() -> dict[str, str]:
    """Return the versions on which the pixels of a figure depend."""
    return {
        "matplotlib": matplotlib.__version__,
        "numpy": np.__version__,
        "freetype": ft2font.__freetype_version__,
        "pillow": version("pillow"),
        "machine": platform.machine(),
    }


def recorded(folder: Path) -> dict:
    """Return the environment and the files of the record; without a record, nothing."""
    try:
        return json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {"environment": {}, "files": []}


def compare(names: Iterable[str], made: Path, folder: Path) -> list[Finding]:
    """Return a finding for each file of `names` below `made` or in the baseline alone."""
    record, names, rules = recorded(folder), set(names), read_rules(folder)
    same = record["environment"] == environment()
    method = compare_images.EXACT if same else compare_images.LOOK
    found: dict[str, Finding] = {}
    # Datasets come first, since an image is judged by whether the curves in it have moved.
    for name in sorted({*names, *record["files"]}, key=lambda each: not each.endswith(".nc")):
        if absent := _absent(name, names, made, folder):
            found[name] = absent
        elif name.endswith(".nc"):
            found[name] = _compare_dataset(name, made, folder, rules)
        else:
            shown = found.get(name.removesuffix(".png") + ".nc")
            moved = shown is not None and not shown.is_fault and shown.moved
            pair = folder / name, made / name
            found[name] = compare_images.compare(name, *pair, method, moved)
    return sorted(found.values(), key=lambda each: (STATUSES.index(each.status), each.name))


def _absent(name: str, names: set[str], made: Path, folder: Path) -> Finding | None:
    """Return the finding for a file that cannot be compared because one of the two is absent."""
    if name not in names:
        return Finding(name, MISSING, "is in the baseline, but no longer among the results")
    if not (made / name).exists():
        return Finding(name, MISSING, "was not made")
    if not (folder / name).exists():
        return Finding(name, EXTRA, "is not in the baseline")
    return None


def _compare_dataset(name: str, made: Path, folder: Path, rules: list[Rule]) -> Finding:
    try:
        accepted, new = read(folder / name), thin(read(made / name))
    except DatasetError as error:
        return Finding(name, DAMAGED, str(error).split(":")[0])
    return compare_data.compare(name, accepted, new, rules)


def thin(data: xr.Dataset) -> xr.Dataset:
    """Return the dataset as the baseline keeps it: every 2nd, 4th, ... sample, in single precision.

    Single precision resolves 6e-8, less than any tolerance. The longest dimension is thinned first.
    """
    while sum(variable.size for variable in data.variables.values()) > MOST_NUMBERS:
        longest = max(data.sizes, key=data.sizes.get)
        data = data.isel({longest: slice(None, None, 2)})
    kept = {}
    for name, variable in data.variables.items():
        kept[name] = xr.Variable(variable.dims, variable.values, dict(variable.attrs))
        if variable.dtype.kind == "f":
            kept[name] = kept[name].astype("float32")
    coordinates = {name: kept.pop(name) for name in data.coords}
    return xr.Dataset(kept, coordinates, {"thinned": "for tests/baseline"})


def accept(names: Iterable[str], made: Path, folder: Path) -> list[str]:
    """Take the files `names` below `made` as the baseline; return the names of what changed."""
    names, before = sorted(names), set(recorded(folder)["files"])
    changed = [name for name in names if _take(made / name, folder / name)]
    for name in sorted(before - set(names)):
        (folder / name).unlink(missing_ok=True)
        changed.append(f"{name} (removed)")
    record = {"environment": environment(), "files": names}
    with complete_or_absent(folder / RECORD) as partial:
        partial.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    return changed


def _take(new: Path, accepted: Path) -> bool:
    """Replace one accepted file unless its content is the same, so that a commit shows changes."""
    if new.suffix == ".nc":
        return _take_dataset(thin(read(new)), accepted)
    if accepted.exists() and accepted.read_bytes() == new.read_bytes():
        return False
    with complete_or_absent(accepted) as partial:
        shutil.copyfile(new, partial)
    return True


def _take_dataset(thinned: xr.Dataset, accepted: Path) -> bool:
    try:
        # `save` adds attributes of its own to the file, which are no change.
        known = read(accepted).drop_attrs(deep=False)
        if thinned.drop_attrs(deep=False).identical(known):
            return False
    except DatasetError:
        pass  # an absent or damaged file is written anew
    for variable in thinned.variables.values():
        if variable.dtype.kind in "fiu" and variable.size > 100:
            variable.encoding = {"zlib": True, "complevel": 9, "shuffle": True}
    save(accepted, thinned)
    return True
