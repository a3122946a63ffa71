"""Measure Lyapunov exponents, and when runs leave the solution as these predict."""

from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.chaos.lyapunov import divergence_times, largest_exponents, spectra


def measure_lyapunov(
    data: str,
    problems: dict[str, dict],
    end_time: float,
    tolerances: list[float],
    short_problems: dict[str, dict],
    short_end_times: dict[int, float],
    undriven_end: float,
    seed: int,
    kernels: list[str] | tuple = (),
) -> None:
    """Follow `problems` to `end_time`; then all changes of `short_problems` on short chains.

    `short_end_times` gives the end time for each half-width. The shortest chain is also followed
    without a drive, to `undriven_end`. `seed` draws the tangent vectors.
    """
    cases = by_name(problems)
    growth, attributes = largest_exponents(cases, end_time, seed)
    times = divergence_times(cases, tolerances, growth)
    short = spectra(by_name(short_problems), short_end_times, undriven_end, seed)
    write(data, growth | times | short, attributes)


if __name__ == "__main__":
    from job import run

    run(measure_lyapunov, snakemake)  # noqa: F821
