"""Set the paper's own trajectories and sweeps beside the bounds of its theorems."""

import xarray
from pendula.datasets.checks import describe
from pendula.datasets.netcdf import read, save
from pendula.studies.theory.bounds import check_cases, check_sweeps


def check_observed(
    trajectories: list[str],
    sweeps: list[str],
    cases: list[str],
    swept: list[str],
    cases_check: str,
    sweeps_check: str,
) -> None:
    """Write both checks; `cases` and `swept` name the trajectories and sweeps in their order."""
    found = {
        cases_check: check_cases(dict(zip(cases, map(read, trajectories), strict=True))),
        sweeps_check: check_sweeps(dict(zip(swept, map(read, sweeps), strict=True))),
    }
    for name, (path, check) in zip(("cases", "sweeps"), found.items(), strict=True):
        print(describe(name, check))
        save(path, xarray.Dataset.from_dict(check))


if __name__ == "__main__":
    from job import run

    run(check_observed, snakemake)  # noqa: F821
