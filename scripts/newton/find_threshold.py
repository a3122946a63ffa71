"""Find the drive at which the pendula at rest lose stability, and how fast they leave."""

from pendula.datasets.netcdf import write
from pendula.studies.pendula.threshold import threshold_contents


def find_threshold(
    data: str,
    epsilon: float,
    omegas: list[float],
    mus: list[float],
    half_width: int,
    growth_omegas: list[float],
    gammas: list[float],
    curve_omegas: list[float],
) -> None:
    """Write thresholds and rates of growth of the infinite chain and of a finite one."""
    found = threshold_contents(
        epsilon, omegas, mus, half_width, growth_omegas, gammas, curve_omegas
    )
    write(data, *found)


if __name__ == "__main__":
    from job import run

    run(find_threshold, snakemake)  # noqa: F821
