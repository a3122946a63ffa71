"""Map what becomes of data on one pair."""

import numpy as np
from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.breathers.contents import fates_contents


def map_fates(
    data: str, problems: dict[float, dict], amplitudes: list[float], kernels: list[str] | tuple = ()
) -> None:
    """Write the fate of each pair of `amplitudes` for the problem of each detuning."""
    write(data, *fates_contents(by_name(problems), np.array(amplitudes)))


if __name__ == "__main__":
    from job import run

    run(map_fates, snakemake)  # noqa: F821
