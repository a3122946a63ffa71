"""Compare a dataset with that of the baseline, curve by curve."""

from pathlib import Path

import xarray as xr

from pendula.datasets.netcdf import DatasetError, read

from .curves import Curve, curves, thin
from .findings import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding
from .numbers import SAME, Deviation, deviation
from .tolerances import rule_for


def compare(name: str, reference: Path, new: Path) -> Finding:
    """Return what became of a dataset; `name` is its path below results/."""
    try:
        accepted, made = read(reference), thin(read(new))
    except DatasetError as error:
        return Finding(name, DAMAGED, str(error).split(":")[0])
    stem = name.removesuffix(".nc")
    return judge(name, accepted, made, stem)


def judge(name: str, accepted: xr.Dataset, made: xr.Dataset, stem: str) -> Finding:
    """Return the finding of the curve that is off the most, and count the others."""
    was, now = ({c.label: c for c in curves(data, stem)} for data in (accepted, made))
    unmatched = _unmatched(was, now)
    if unmatched:
        return Finding(name, DIFFERENT, unmatched)
    found = {
        label: deviation(was[label], now[label], rule_for(label, was[label].largest))
        for label in was
    }
    if all(each == SAME for each in found.values()):
        return Finding(name, IDENTICAL)
    worst = max(found, key=lambda label: found[label].excess)
    faults = sum(each.excess > 1 for each in found.values())
    says = _say(worst.partition(":")[2], found[worst], faults)
    moved = any(each.moved for each in found.values())
    return Finding(name, DIFFERENT if faults else NEARLY, says, moved)


def _say(label: str, found: Deviation, faults: int) -> str:
    others = f" (and {faults - 1} more curves)" if faults > 1 else ""
    allowed = " is allowed" if found.excess < float("inf") else ""
    return f"{label} {found.says}{allowed}{others}"


def _unmatched(was: dict[str, Curve], now: dict[str, Curve]) -> str:
    """Return which curves came or went, in words."""
    lost, came = ([x for x in a if x not in b] for a, b in ((was, now), (now, was)))
    said = []
    for labels, verb in ((lost, "is gone"), (came, "is new")):
        if labels:
            more = f" (and {len(labels) - 1} more)" if len(labels) > 1 else ""
            said.append(f"{labels[0].partition(':')[2]} {verb}{more}")
    return ", ".join(said)
