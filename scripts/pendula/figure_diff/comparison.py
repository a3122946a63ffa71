"""Compare all that a run made with the baseline."""

from collections.abc import Iterable
from pathlib import Path

from . import baseline, images, tables
from .findings import EXTRA, MISSING, STATUSES, Finding


def compare(names: Iterable[str], made: Path, folder: Path) -> list[Finding]:
    """Return a finding for each of `names`, below `made`, and for what only the baseline has."""
    record = baseline.recorded(folder)
    same = record["environment"] == baseline.environment()
    method = images.EXACT if same else images.LOOK
    found: dict[str, Finding] = {}
    # datasets first: pictures are looked at in the light of what they show
    for name in sorted(
        {*names, *record["files"]}, key=lambda name: (not name.endswith(".nc"), name)
    ):
        found[name] = _compare_one(name, made, folder, set(names), method, found)
    return sorted(found.values(), key=lambda each: (STATUSES.index(each.status), each.name))


def _compare_one(
    name: str, made: Path, folder: Path, names: set[str], method: str, found: dict[str, Finding]
) -> Finding:
    if name not in names:
        return Finding(name, MISSING, "is in the baseline, but no longer among the results")
    if not (made / name).exists():
        return Finding(name, MISSING, "was not made")
    if not (folder / name).exists():
        return Finding(name, EXTRA, "is not in the baseline")
    if name.endswith(".nc"):
        return tables.compare(name, folder / name, made / name)
    shown = found.get(name.removesuffix(".png") + ".nc")
    moved = shown is not None and not shown.is_fault and shown.moved
    return images.compare(name, folder / name, made / name, method, moved)
