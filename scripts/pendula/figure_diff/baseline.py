"""The accepted results in tests/baseline: what they are, what made them, how they are replaced."""

import json
import platform
import shutil
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib import ft2font

from pendula.datasets.files import complete_or_absent
from pendula.datasets.netcdf import DatasetError, read, save

from .curves import thin

RECORD = "accepted.json"
"""Names every file of the baseline, and what drew it."""


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
    """Return what the record says: the environment and the files. Without a record, nothing."""
    try:
        return json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {"environment": {}, "files": []}


def accept(names: Iterable[str], made: Path, folder: Path) -> list[str]:
    """Take the files `names` below `made` as the baseline; return what was changed."""
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
    """Replace one file unless it says the same already, so that a commit shows what changed."""
    if new.suffix != ".nc":
        if accepted.exists() and accepted.read_bytes() == new.read_bytes():
            return False
        accepted.parent.mkdir(parents=True, exist_ok=True)
        with complete_or_absent(accepted) as partial:
            shutil.copyfile(new, partial)
        return True
    thinned = thin(read(new))
    try:
        if thinned.identical(read(accepted)):
            return False
    except DatasetError:
        pass  # absent or damaged: written anew
    for variable in thinned.variables.values():
        if variable.dtype.kind in "fiu" and variable.size > 100:
            variable.encoding = {"zlib": True, "complevel": 9, "shuffle": True}
    save(accepted, thinned)
    return True
