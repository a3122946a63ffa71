"""Find periodic breathers and how fast their perturbations grow."""

from pendula.datasets.netcdf import write
from pendula.studies.breathers.periodic_contents import periodic_contents


def find_periodic(
    data: str,
    epsilon: float,
    gamma: float,
    omegas: list[float],
    frequencies: list[float],
    half_widths: dict[str, int],
    kernels: list[str] | tuple = (),
) -> None:
    """Write the three families at each Omega and frequency."""
    write(data, *periodic_contents(epsilon, gamma, omegas, frequencies, half_widths))


if __name__ == "__main__":
    from job import run

    run(find_periodic, snakemake)  # noqa: F821
