"""Datasets whose numbers come from `numerics`; started as a program on each machine.

    python tests/some_numbers.py given made

makes them from runs on infinite chains in the folder `given`, and from small arguments, in the
functions that the rules call, and writes them to the folder `made`. What solvers give is asked by
bits.py.
"""

import sys
from pathlib import Path

from latticode.datasets.netcdf import read, save, write
from pendula.studies.certified.proved_breathers import breathers_contents
from pendula.studies.theory.checks import CHECKS, run_checks
from pendula.studies.unbounded.measured import measure_fronts
from pendula.studies.unbounded.thermal import solve_thermal

NODES = 6
PROVED = [{"family": "asymmetric real", "omega": -10.0, "epsilon": 1.0}]
"""A steady breather whose proof takes a state and an inverse in balls."""
NAMES = (*CHECKS, "fronts", "thermal", "proofs")


def make(given: Path, made: Path) -> None:
    """Write the datasets of NAMES to the folder `made`."""
    datasets = dict(zip(CHECKS, run_checks(), strict=True))
    runs = (read(str(given / f"{name}.nc")) for name in ("omegas", "thermal"))
    for name, data in (datasets | {"fronts": measure_fronts(*runs)}).items():
        save(str(made / f"{name}.nc"), data)
    write(str(made / "thermal.nc"), *solve_thermal(1.0, 1.0, [-1.0], NODES))
    write(str(made / "proofs.nc"), *breathers_contents(1.0, 8, PROVED, []))


if __name__ == "__main__":
    make(Path(sys.argv[1]), Path(sys.argv[2]))
