"""What differs between the same results of two machines, told by file, variable and size.

    python unlike.py here there

compares the variables of all datasets of two folders: their bytes depend on the version of netCDF.
"""

import sys
from pathlib import Path

import netCDF4
import numpy as np


def unlike(here: Path, there: Path, *kinds: str) -> list[str]:
    """Return a line for each file whose bytes differ, for a dataset one for each variable."""
    names = files(here, kinds)
    assert names, f"no {kinds} in {here}"
    said = [f"{name} is made on one machine only" for name in names ^ files(there, kinds)]
    for name in sorted(names & files(there, kinds)):
        pair = here / name, there / name
        if pair[0].read_bytes() != pair[1].read_bytes():
            said += variables(name, *pair) if name.endswith(".nc") else [f"{name} differs"]
    return said


def files(results: Path, kinds: tuple[str, ...]) -> set[str]:
    """Return the names of the results of these kinds; logs hold times, which no two runs share.

    So does the report, and no test asks for its kind.
    """
    paths = [path.relative_to(results) for path in results.rglob("*") if path.suffix in kinds]
    return {str(path) for path in paths if path.parts[0] != "logs"}


def variables(name: str, here: Path, there: Path) -> list[str]:
    """Return what differs in a dataset: how far each variable is off, or that none of them is."""
    with netCDF4.Dataset(here) as one, netCDF4.Dataset(there) as other:
        said = [f"{each} is in one of them only" for each in one.variables.keys() ^ other.variables]
        for each in sorted(one.variables.keys() & other.variables.keys()):
            pair = np.asarray(one[each][...]), np.asarray(other[each][...])
            said += [f"{each} {difference(*pair)}"] if difference(*pair) else []
    return [f"{name}: {each}" for each in said or ["attributes differ"]]


def difference(one: np.ndarray, other: np.ndarray) -> str:
    """Return in words how far two arrays are apart, and nothing where their bits are the same."""
    if one.shape != other.shape:
        return f"has the shapes {one.shape} and {other.shape}"
    if one.dtype.kind != "f":
        return "" if np.array_equal(one, other) else "differs"
    if one.tobytes() == other.tobytes():
        return ""
    apart = abs(np.where(one == other, 0, one - other))
    return f"differs by {np.nanmax(apart):.2g} of {np.nanmax(abs(one)):.2g}"


if __name__ == "__main__":
    said = [
        one for one in unlike(*map(Path, sys.argv[1:]), ".nc") if "attributes differ" not in one
    ]
    sys.exit("\n".join(said) or None)
