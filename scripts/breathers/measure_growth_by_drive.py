"""Measure how a localised motion grows by the drive, beside the law of weak drives."""

from pendula.datasets.netcdf import write
from pendula.studies.breathers.contents import growth_contents


def measure_growth_by_drive(
    data: str,
    epsilon: float,
    omega: float,
    end_times: dict[float, float],
    frequencies: list[float],
    start: float,
    half_widths: dict[str, int],
    outputs: int,
    tolerance: float,
    kernels: list[str] | tuple = (),
) -> None:
    """Write what a breather of the frequency `start` gains under each drive."""
    found = growth_contents(
        epsilon, omega, end_times, frequencies, start, half_widths, outputs, tolerance
    )
    write(data, *found)


if __name__ == "__main__":
    from job import run

    run(measure_growth_by_drive, snakemake)  # noqa: F821
