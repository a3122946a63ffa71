"""Datasets whose numbers come from `numerics`; started as a program on each machine.

    python tests/some_numbers.py given made [theory]

makes them from runs on infinite chains in the folder `given`, and from small arguments, in the
functions that the rules call, and writes them to the folder `made`; by the third word all checks of
the theory in place of a few small ones. What solvers give is asked by bits.py.
"""

import sys
from pathlib import Path

import xarray
from helpers import chosen
from latticode.datasets.netcdf import read, save, write
from pendula.studies.certified.proved_breathers import breathers_contents
from pendula.studies.theory.checks import run_check
from pendula.studies.unbounded.measured import measure_fronts
from pendula.studies.unbounded.thermal import solve_thermal

CHECKS = {
    "threshold": {"sizes": [3, 5, 9], "end_time": 5.0},  # random numbers
    "sharpness": {"sites": 9},
}
"""One check for each kind of function in `numerics`, with what makes it take no time."""
NODES = 6
PROVED = [{"family": "asymmetric real", "omega": -10.0, "epsilon": 1.0}]
"""A steady breather whose proof takes a state, an inverse in balls, and a spectrum."""
NAMES = (*CHECKS, "fronts", "thermal", "proofs")


def make(given: Path, made: Path, *every: str) -> None:
    """Write the datasets of NAMES to the folder `made`, or with all checks of the theory."""
    theory = chosen("theory")
    arguments = theory.arguments("theory")
    smaller = {name: {} for name in arguments} if every else CHECKS
    checks = {name: run_check(name, arguments[name] | less) for name, less in smaller.items()}
    datasets = {name: xarray.Dataset.from_dict(check) for name, check in checks.items()}
    runs = (read(str(given / f"{name}.nc")) for name in ("omegas", "thermal"))
    for name, data in (datasets | {"fronts": measure_fronts(*runs)}).items():
        save(str(made / f"{name}.nc"), data)
    write(str(made / "thermal.nc"), *solve_thermal(1.0, 1.0, [-1.0], NODES))
    write(str(made / "proofs.nc"), *breathers_contents(1.0, {"block": 8, "chain": 4}, PROVED, []))


if __name__ == "__main__":
    make(Path(sys.argv[1]), Path(sys.argv[2]), *sys.argv[3:])
