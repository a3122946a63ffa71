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
from pendula.problem import Constants
from pendula.studies.certified.proved_breathers import breathers_contents
from pendula.studies.theory.checks import run_check
from pendula.studies.unbounded.measured import measure_fronts, measure_growth
from pendula.studies.unbounded.thermal import maximum_variables, state_of_energy, thermal_variables

CHECKS = {
    "windows": {},  # bisection
    "samples": {"count": 2, "sizes": [3]},  # random numbers
    "sharpness": {"sizes": [3, 9]},  # extrapolation
}
"""One check for each kind of function in `numerics`, with what makes it take no time."""
NODES = 6
GROWN = ("fig4_small", "fig3_large", "fig3_small", "fig2_large")
UNBOUNDED = ("growth", "fronts", "thermal")
PROVED = [{"family": "asymmetric real", "omega": -10.0, "epsilon": 1.0}]
"""A steady breather whose proof takes a state, an inverse in balls, and a spectrum."""
NAMES = (*CHECKS, *UNBOUNDED, "proofs")


def unbounded(given: Path) -> dict[str, xarray.Dataset]:
    """Return what is fitted to and averaged over runs on infinite chains, and thermal states."""
    runs = {path.stem: read(str(path)) for path in given.glob("*.nc")}
    states = runs["thermal"], runs["transverse"]
    growth = measure_growth({name: runs[name] for name in GROWN}, *states)
    return {"growth": growth, "fronts": measure_fronts(runs["omegas"], *states[::-1])}


def make(given: Path, made: Path, *every: str) -> None:
    """Write the datasets of NAMES to the folder `made`, or with all checks of the theory."""
    theory = chosen("theory")
    arguments = theory.arguments("stability") | theory.arguments("bounds")
    smaller = {name: {} for name in arguments} if every else CHECKS
    checks = {name: run_check(name, arguments[name] | less) for name, less in smaller.items()}
    datasets = {name: xarray.Dataset.from_dict(check) for name, check in checks.items()}
    for name, data in (datasets | unbounded(given)).items():
        save(str(made / f"{name}.nc"), data)
    constants = Constants(epsilon=1.0, gamma=1.0, omega=-1.0)
    both, alone = (state_of_energy(constants, 0.0, NODES, alike) for alike in (False, True))
    thermal = thermal_variables([both], [alone]) | maximum_variables(both)
    write(str(made / "thermal.nc"), thermal, {})
    write(str(made / "proofs.nc"), *breathers_contents(1.0, {"block": 8, "chain": 4}, PROVED, []))


if __name__ == "__main__":
    make(Path(sys.argv[1]), Path(sys.argv[2]), *sys.argv[3:])
