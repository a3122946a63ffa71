"""The quick run on another machine, played on this one: the same files to the last bit.

Only one other machine runs here, since a run with its kernels takes minutes; `.ci/elsewhere`
takes all of them through the full run.
"""

import machines
import netCDF4
import numpy as np
import pytest
from helpers import ROOT, skip, snakemake

MACHINE = "generic"  # of those in tests/machines.py it is the one with the most other bits


@pytest.fixture(scope="module")
def run_there(made_once):
    """Return a folder with the results of a quick run on MACHINE."""
    if why := machines.why_not(MACHINE):
        skip(why, machines.ELSEWHERE)
    cores = f"--cores={machines.PLAYED[MACHINE].cores}"

    def make(directory):
        result = snakemake(ROOT, directory, cores, env=machines.environment(MACHINE))
        assert result.returncode == 0, result.stdout + result.stderr

    return made_once(f"{MACHINE}_run", make)


def test_datasets(full_run, run_there):
    assert unlike(full_run, run_there, ".nc") == []


def test_claims_controls_tables_and_what_is_written_beside_figures(full_run, run_there):
    assert unlike(full_run, run_there, ".json", ".md", ".txt") == []


def test_pictures(full_run, run_there):
    assert unlike(full_run, run_there, ".png", ".pdf") == []


def test_a_bit_that_differs_is_told_by_file_variable_and_size(tmp_path):
    for folder, last in (("here", 2.0), ("there", np.nextafter(2.0, 3))):
        path = tmp_path / folder / "results/checks/one.nc"
        path.parent.mkdir(parents=True)
        with netCDF4.Dataset(path, "w") as data:
            data.createDimension("tau", 2)
            for name in ("same", "other"):
                data.createVariable(name, float, "tau")[:] = [1, last if name == "other" else 2]
    assert unlike(tmp_path / "here", tmp_path / "there", ".nc") == [
        "checks/one.nc: other differs by 4.4e-16 of 2"
    ]


def unlike(here, there, *kinds):
    """Return a line for each file whose bytes differ, for a dataset one for each variable."""
    names = files(here, kinds)
    assert names, f"no {kinds} in {here}"
    said = [f"{name} is made on one machine only" for name in names ^ files(there, kinds)]
    for name in sorted(names & files(there, kinds)):
        pair = here / "results" / name, there / "results" / name
        if pair[0].read_bytes() != pair[1].read_bytes():
            said += variables(name, *pair) if name.endswith(".nc") else [f"{name} differs"]
    return said


def files(run, kinds):
    """Return the names of the results of these kinds; logs hold times, which no two runs share.

    So does the report, and no test asks for its kind.
    """
    results = run / "results"
    paths = [path.relative_to(results) for path in results.rglob("*") if path.suffix in kinds]
    return {str(path) for path in paths if path.parts[0] != "logs"}


def variables(name, here, there):
    """Return what differs in a dataset: how far each variable is off, or that none of them is."""
    with netCDF4.Dataset(here) as one, netCDF4.Dataset(there) as other:
        said = [f"{each} is in one of them only" for each in one.variables.keys() ^ other.variables]
        for each in sorted(one.variables.keys() & other.variables.keys()):
            pair = np.asarray(one[each][...]), np.asarray(other[each][...])
            said += [f"{each} {difference(*pair)}"] if difference(*pair) else []
    return [f"{name}: {each}" for each in said or ["attributes differ"]]


def difference(one, other):
    """Return in words how far two arrays are apart, and nothing where their bits are the same."""
    if one.shape != other.shape:
        return f"has the shapes {one.shape} and {other.shape}"
    if one.dtype.kind != "f":
        return "" if np.array_equal(one, other) else "differs"
    if one.tobytes() == other.tobytes():
        return ""
    apart = abs(np.where(one == other, 0, one - other))
    return f"differs by {np.nanmax(apart):.2g} of {np.nanmax(abs(one)):.2g}"
