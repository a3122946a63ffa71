"""Map what becomes of data on one pair."""

import numpy as np
from pendula.datasets.netcdf import read, write
from pendula.problem import by_name
from pendula.studies.breathers.fate_contents import Grid, fates_contents


def map_fates(
    data: str,
    periodic: str,
    problems: dict[float, dict],
    amplitudes: list[float],
    turned: list[float],
    phases: list[float],
    ratio: float,
    checked: int,
    cases: dict[str, dict],
    kernels: list[str] | tuple = (),
    fine: str | None = None,
) -> None:
    """Write the fate of (A_0, B_0), of B_0 turned in phase, and of the paper's `cases`.

    `fine` has committed maps, which those of this run are compared with.
    """
    grid = Grid(np.array(amplitudes), np.array(turned), np.array(phases), ratio, checked)
    beside = None if fine is None else read(fine)
    write(data, *fates_contents(by_name(problems), grid, by_name(cases), read(periodic), beside))


if __name__ == "__main__":
    from job import run

    run(map_fates, snakemake)  # noqa: F821
