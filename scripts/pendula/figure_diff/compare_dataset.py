"""Compares a dataset with the accepted one: by its hashes, and where they differ by what it holds.

Type, shape, attributes and units are exact. Numbers with other bits are compared curve by curve
(`compare_curves`), and must agree with each other: what a chain has in all at a time is the sum of
what its sites have. A fault that grows slowly enough to pass as chaos, and is planted into all
copies of a norm, breaks that.
"""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from pendula.datasets.netcdf import DatasetError

from . import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding, compare_curves, hashes
from .tolerances import Tolerances

AGREE = 1e-6
"""How far norms may be from those of the moduli in the same file, as a fraction of the largest:
files hold moduli in single precision, which gives 6e-8."""

NORMS = {
    "linf": ("largest modulus of the sites", lambda moduli, site: moduli.max(site)),
    "l2": (
        "root of the sum of squares over the sites",
        lambda moduli, site: np.sqrt((moduli**2).sum(site)),
    ),
}
"""Variables that must be what follows from `modulus` at the times of snapshots."""


def compare(
    name: str, made: Path, folder: Path, accepted: hashes.Hashes, tolerances: Tolerances
) -> Finding:
    """Return the finding for the dataset `name` below `made`, whose accepted copy is in `folder`.

    `folder` is None where only the accepted bits are right and no copy is kept.
    """
    try:
        new = hashes.read(made / name)
    except DatasetError:
        return Finding(name, DAMAGED, "cannot be read")
    now = hashes.of(new)
    if now == accepted:
        return Finding(name, IDENTICAL)
    unlike = hashes.unlike_in_values(accepted, now)
    faults = hashes.unlike_in_kind(accepted, now)
    if folder is None:
        says = ", ".join([*faults, *unlike]) or "attributes"
        return Finding(name, DIFFERENT, f"is not the accepted reference: other bits in {says}")
    known = hashes.read(folder / name)
    if not hashes.same_attributes(accepted, now):
        faults += hashes.unlike_in_attributes(known, new, moved=bool(unlike))
    faults += contradictions(new.variables)
    if faults:
        more = f" (and {len(faults) - 3} more)" if len(faults) > 3 else ""
        return Finding(name, DIFFERENT, "; ".join(faults[:3]) + more)
    pair = hashes.as_dataset(known), hashes.as_dataset(hashes.as_kept(new))
    found = compare_curves.compare(name, *pair, tolerances, lambda other: _as_kept(made / other))
    return _with_other_bits(found, unlike)


def _as_kept(path: Path):
    return hashes.as_dataset(hashes.as_kept(hashes.read(path)))


def _with_other_bits(found: Finding, unlike: list[str]) -> Finding:
    """Return what the curves of a dataset with other bits say: it is never `identical`."""
    if found.is_fault:
        return found
    others = f" and {len(unlike) - 3} more" if len(unlike) > 3 else ""
    bits = f"other bits in {', '.join(unlike[:3])}{others}"
    if found.status == IDENTICAL:
        says = "by less than single precision shows (6e-8)"
        return Finding(found.name, NEARLY, f"{bits}, {says}")
    return replace(found, says=f"{bits}: {found.says}")


def contradictions(variables: Mapping[str, hashes.Variable]) -> list[str]:
    """Return in words which norms do not follow from the moduli of a trajectory.

    `modulus` has the dimensions (component, site, snapshot), the norms (component, tau). A dataset
    without them contradicts nothing.
    """
    if not {"modulus", "snapshot_tau", "tau"} <= variables.keys():
        return []
    modulus = variables["modulus"]
    site = modulus.dimensions.index("site")
    times, snapshots = variables["tau"].values, variables["snapshot_tau"].values
    at = np.abs(times[:, None] - snapshots).argmin(0)
    said = []
    for name, (meaning, norm) in NORMS.items():
        if name not in variables:
            continue
        expected = norm(modulus.values.astype(float), site)
        found = variables[name].values[:, at]
        with np.errstate(invalid="ignore"):
            off = abs(found - expected).max(0) / (np.nanmax(expected) or 1.0)
        if not (off <= AGREE).all():
            worst = int(np.nan_to_num(off, nan=np.inf).argmax())
            said.append(
                f"{name} is off by {off[worst]:.2g} of its scale from the {meaning}, "
                f"which the same file holds, at tau = {snapshots[worst]:.4g}"
            )
    return said
