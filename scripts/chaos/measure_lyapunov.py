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
    short_end_time: float,
    kernels: list[str] | tuple = (),
) -> None:
    """Follow `problems` to `end_time`, and all changes of `short_problems` to their own."""
    cases, short_cases = by_name(problems), by_name(short_problems)
    growth, attributes = largest_exponents(cases, end_time)
    times = divergence_times(cases, tolerances, growth)
    short = {
        "spectrum_half_width": next(iter(short_cases.values())).half_width,
        "spectrum_end_time": short_end_time,
    }
    write(data, growth | times | spectra(short_cases, short_end_time), attributes | short)


if __name__ == "__main__":
    from job import run

    run(measure_lyapunov, snakemake)  # noqa: F821
