"""Sample the thermal states without energy, with which the bulk behind the front is compared."""

from pendula.datasets.netcdf import write
from pendula.problem import Constants
from pendula.studies.unbounded.bulk import KEPT, SEED, SITES, thermal_variables, zero_energy


def sample_thermal(data: str, epsilon: float, gamma: float, omegas: list[float]) -> None:
    """Write power, temperature, spectrum and distribution of one state for each Omega."""
    found = [zero_energy(Constants(epsilon=epsilon, gamma=gamma, omega=omega)) for omega in omegas]
    title = "Thermal states without energy, by the algorithm of Metropolis on a ring"
    ring = {"boundary": "periodic", "sites": SITES, "samples": KEPT, "seed": SEED}
    attributes = {"title": title, "epsilon": epsilon, "gamma": gamma, **ring}
    write(data, thermal_variables(omegas, found), attributes)


if __name__ == "__main__":
    from job import run

    run(sample_thermal, snakemake)  # noqa: F821
