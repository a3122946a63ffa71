"""Follow stable periodic breathers from slightly changed data for thousands of periods."""

from pendula.datasets.netcdf import write
from pendula.studies.breathers.periodic_contents import perturbed_contents


def perturb_breathers(
    data: str,
    epsilon: float,
    gamma: float,
    omegas: list[float],
    half_widths: dict[str, int],
    frequencies: list[float],
    change: float,
    end_time: float,
    tolerance: float,
    kernels: list[str] | tuple = (),
) -> None:
    """Write how P on the central pair swings early and late, for each family, Omega, frequency."""
    grid = (omegas, frequencies, half_widths)
    write(data, *perturbed_contents(epsilon, gamma, *grid, change, end_time, tolerance))


if __name__ == "__main__":
    from job import run

    run(perturb_breathers, snakemake)  # noqa: F821
