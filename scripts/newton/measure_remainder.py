"""Measure how far the expansion and its next order are from the pendula."""

from job import step
from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.pendula.remainder import remainder_contents


def measure_remainder(
    data: str,
    problems: dict[str, dict],
    run_ends: dict[str, dict[float, float]],
    end_step: float,
    spacing: float,
) -> None:
    """Write the errors of the cases up to the end of each run."""
    write(data, *remainder_contents(by_name(problems), run_ends, end_step, spacing, step))


if __name__ == "__main__":
    from job import run

    run(measure_remainder, snakemake)  # noqa: F821
