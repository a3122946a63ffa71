"""What differs between the same results of two machines, told by file, variable and size.

    python unlike.py here there

compares the variables of all datasets of two folders: their bytes depend on the version of netCDF.
"""

import sys
from pathlib import Path

import netCDF4
import numpy as np


def unlike(here: Path, there: Path, *kinds: str) -> list[str]:
    """Return a line for each file whose bytes differ, for a dataset one for each variable.

    Logs hold times, which no two runs share.
    """
    names, others = (
        {path.relative_to(results) for path in results.rglob("*") if path.suffix in kinds}
        for results in (here, there)
    )
    assert names, f"no {kinds} in {here}"
    said = [f"{name} is made on one machine only" for name in names ^ others]
    for name in sorted(names & others):
        one, other = here / name, there / name
        if name.parts[0] != "logs" and one.read_bytes() != other.read_bytes():
            found = variables(one, other) if name.suffix == ".nc" else ["differs"]
            said += [f"{name}: {each}" for each in found or ["attributes differ"]]
    return said


def variables(here: Path, there: Path) -> list[str]:
    """Return which variables of a dataset differ, and how far they are off."""
    with netCDF4.Dataset(here) as one, netCDF4.Dataset(there) as other:
        said = [f"{name} is in one of them only" for name in one.variables.keys() ^ other.variables]
        for name in sorted(one.variables.keys() & other.variables.keys()):
            a, b = np.asarray(one[name][...]), np.asarray(other[name][...])
            if a.dtype.kind == "f" and a.shape == b.shape and a.tobytes() != b.tobytes():
                apart = abs(np.where(a == b, 0, a - b))
                said.append(f"{name} differs by {np.nanmax(apart):.2g} of {np.nanmax(abs(a)):.2g}")
            elif (a.dtype.kind != "f" and not np.array_equal(a, b)) or a.shape != b.shape:
                said.append(f"{name} differs")
    return said


if __name__ == "__main__":
    said = [
        one for one in unlike(*map(Path, sys.argv[1:]), ".nc") if "attributes differ" not in one
    ]
    sys.exit("\n".join(said) or None)
